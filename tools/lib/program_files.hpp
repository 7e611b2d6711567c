// SPDX-License-Identifier: Apache-2.0
// Program files on disk for a control: main programs by path, sub programs found in a folder when they are
// called.
//
// libnc reads a text through a read-at callback in windows of its own; here that callback is pread() on a
// file kept open, so a program of any size costs one descriptor and no memory. Nothing is mapped: mapped
// pages count as resident.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** Owns the open files of one control; must outlive the control's last read. */
class ProgramFiles {
 public:
  /** @param folder where sub programs are looked for; "" = nowhere. */
  explicit ProgramFiles(std::string folder);
  /** Folder of the programs of M198 (the data server); "" = the same as that of sub programs. */
  void set_external(std::string folder) { external_ = std::move(folder); }
  ~ProgramFiles();
  ProgramFiles(const ProgramFiles&) = delete;
  ProgramFiles& operator=(const ProgramFiles&) = delete;

  /** Enter the file at `path` into the program store under its name without folder. On failure `error` says
   * why. */
  nc_status add(nc_control* control, const std::string& path, unsigned* file, std::string* error);

  /** Enter an open descriptor of a seekable file under `name`; takes the descriptor over, also on failure. */
  nc_status add_descriptor(nc_control* control, int descriptor, const std::string& name, unsigned* file,
                           std::string* error);

  /** Look into the folder whenever `control` misses a sub program. */
  void attach(nc_control* control);

  /** Bytes at the start of `text` that are no part of a program: a UTF-8 byte order mark, as editors write
   * it. */
  static size_t mark_length(const char* text, size_t size);

  /** Path of the file that has this index in the program store; "" when it did not come from here. */
  std::string path_of(unsigned file) const;

  /**
   * File in the folder for "O1000" (the number decides: `o1000.NC`, `O01000` count, with or without an
   * ending) or for the name between < > (its own spelling first, then any case). "" when there is none. The folder
   * is looked at anew each time: a control runs for months, and programs come and go.
   */
  std::string find(const std::string& name) const;

 private:
  struct OpenFile;
  static long read_at(void* user, uint64_t offset, char* buffer, size_t size);
  static bool on_missing(void* user, nc_control* control, const char* name);
  std::string external_;

  std::string folder_;
  std::vector<std::unique_ptr<OpenFile>> files_;
};

}  // namespace nc::tools
