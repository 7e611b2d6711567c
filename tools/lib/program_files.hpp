// SPDX-License-Identifier: Apache-2.0
// Program files on disk for a control: main programs by path, sub programs found in a folder when they are
// called.
//
// A program runs as it was when it was selected, a sub program as it was when it was called first after that
// (runtime/programs/program_text.hpp): what is written into the files meanwhile does nothing until the next
// selection, which takes everything anew; new MDI blocks are one (look_again()). What nothing refers to any more is given up then, or when the
// program store is full of programs that were called, the one first whose last call is longest ago.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "runtime/programs/program_text.hpp"

namespace nc::tools {

/** Owns the texts of one control; must outlive the control's last read. The thread of the feeder. */
class ProgramFiles {
 public:
  using Text = std::shared_ptr<rt::ProgramText>;

  /** @param folder where sub programs are looked for; "" = nowhere. */
  explicit ProgramFiles(std::string folder, const rt::ProgramText::Options& options = {});
  /** Folder of the programs of M198 (the data server); "" = the same as that of sub programs. */
  void set_external(std::string folder) { external_ = std::move(folder); }
  /** Somebody who will select a program again asks for its place to be kept, although the control does not
   * refer to it. */
  void set_remembered(std::function<bool(unsigned file)> remembered) { remembered_ = std::move(remembered); }
  /** Takes what cannot be returned: why a sub program that is there could not be had. */
  void set_report(std::function<void(const std::string&)> report) { report_ = std::move(report); }
  ~ProgramFiles();
  ProgramFiles(const ProgramFiles&) = delete;
  ProgramFiles& operator=(const ProgramFiles&) = delete;

  /** Enter the file at `path` into the program store under its name without folder, to be selected: before the
   * next one is added. Gives up what nothing refers to. On failure `error` says why. */
  nc_status add(nc_control* control, const std::string& path, unsigned* file, std::string* error, bool tape = false);

  /** Enter an open descriptor of a seekable file under `name` in the same way; takes the descriptor over, also on
   * failure. */
  nc_status add_descriptor(nc_control* control, int descriptor, const std::string& name, unsigned* file,
                           std::string* error, bool tape = false);

  /** Give up what nothing refers to: a sub program that is called next comes from its file as it is then. While nothing runs. */
  void look_again(nc_control* control) { give_up_unused(control); }

  /** Names of files that are not what is in the store any more, selected or called: "part.nc, O77"; "" = none. */
  std::string changed() const;

  /** Look into the folder whenever `control` misses a sub program. */
  void attach(nc_control* control);

  /** Path of the file that has this index in the program store; "" when it did not come from here. */
  std::string path_of(unsigned file) const;
  /** How many texts have been entered so far. */
  uint64_t entered() const { return entered_; }
  /** Its text; null when it did not come from here. */
  Text text_of(unsigned file) const;

  /**
   * File in the folder for "O1000" (the number decides: `o1000.NC`, `O01000` count, with or without an
   * ending) or for the name between < > (its own spelling first, then any case). "" when there is none. The folder
   * is looked at anew each time: a control runs for months, and programs come and go.
   */
  std::string find(const std::string& name) const;
  /** The same for a program in another place: "198:O5", "D1:<name>", as nc_program_missing names it. */
  std::string find_called(const std::string& name) const;

 private:
  struct Entry;
  nc_status enter(nc_control* control, int descriptor, const std::string& path, const std::string& name,
                  const rt::ProgramText::Options& options, unsigned* file, std::string* error);
  void give_up_unused(nc_control* control);
  bool make_room(nc_control* control);
  void forget(unsigned file);
  const Entry* entry(unsigned file) const;
  static long read_at(void* user, uint64_t offset, char* buffer, size_t size);
  static bool on_missing(void* user, nc_control* control, const char* name);

  std::string folder_, external_;
  const rt::ProgramText::Options options_;
  std::function<bool(unsigned)> remembered_;
  std::function<void(const std::string&)> report_;
  std::vector<std::unique_ptr<Entry>> entries_;
  uint64_t entered_ = 0;
};

}  // namespace nc::tools
