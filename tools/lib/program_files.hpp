// SPDX-License-Identifier: Apache-2.0
// Program files on disk for a control: main programs by path, sub programs found in a folder when they are
// called.
//
// A program runs as it was when it was selected, a sub program as it was when it was first called after that
// (runtime/programs/program_text.hpp). What is written into the files meanwhile has no effect until the next
// selection, which takes all texts anew; loading MDI blocks counts as a selection (look_again()). Programs to which nothing refers any more are removed then.
// They are also removed when the program store is full, beginning with the one whose last call is longest ago.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nc/nc.h"
#include "runtime/programs/program_text.hpp"

namespace nc::tools {

/** Owns the texts of one control; must outlive the last read of the control. To be used in the feeder thread. */
class ProgramFiles {
 public:
  using Text = std::shared_ptr<rt::ProgramText>;

  /** @param folder folder in which sub programs are looked for; "" = none. */
  explicit ProgramFiles(std::string folder, const rt::ProgramText::Options& options = {});
  /** Folder of the programs of M198 (the data server); "" = the same as that of sub programs. */
  void set_external(std::string folder) { external_ = std::move(folder); }
  /** Sets a function that says which programs must be kept although the control does not refer to them, because they will be
   * selected again. */
  void set_remembered(std::function<bool(unsigned file)> remembered) { remembered_ = std::move(remembered); }
  /** Sets a function that is told why an existing sub program could not be read; there is no caller to whom that could be returned. */
  void set_report(std::function<void(const std::string&)> report) { report_ = std::move(report); }
  /** Sets functions for those who show programs: a text has got this index in the program store, before a block of it can be read; the store has dropped it. */
  void set_watch(std::function<void(unsigned file, const std::string& path, const Text& text)> entered, std::function<void(unsigned file)> dropped) {
    told_entered_ = std::move(entered);
    told_dropped_ = std::move(dropped);
  }
  /** Sets a function that is asked before each read of a text: when it is true, nothing more can be read. For who must not look at a text without an end. */
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }
  ~ProgramFiles();
  ProgramFiles(const ProgramFiles&) = delete;
  ProgramFiles& operator=(const ProgramFiles&) = delete;

  /** Enters the file at `path` into the program store under its name without folder. It must be selected before the
   * next one is added. Removes programs to which nothing refers. On failure `error` says why. */
  nc_status add(nc_control* control, const std::string& path, unsigned* file, std::string* error, bool tape = false);

  /** Enters an open descriptor of a seekable file under `name` in the same way; takes over the descriptor, even on
   * failure. */
  nc_status add_descriptor(nc_control* control, int descriptor, const std::string& name, unsigned* file,
                           std::string* error, bool tape = false);

  /** Removes programs to which nothing refers, so that a sub program that is called next is read from its file again. To be called while no program runs. */
  void look_again(nc_control* control) { give_up_unused(control); }

  /** The texts that are entered now, with the paths of their files. */
  std::vector<std::pair<std::string, Text>> texts() const;

  /** Names of files that have changed since they were entered, both selected and called ones: "part.nc, O77"; "" = none. */
  std::string changed() const;

  /** From now on looks into the folder whenever `control` misses a sub program. */
  void attach(nc_control* control);

  /** Path of the file that has this index in the program store; "" when it did not come from here. */
  std::string path_of(unsigned file) const;
  /** How many texts have been entered so far. */
  uint64_t entered() const { return entered_; }
  /** Text of the file that has this index in the program store; null when it did not come from here. */
  Text text_of(unsigned file) const;
  /** SHA-256 of that text, of one that is not copied of what the file system says of its file; "" when it did not come from here or cannot be read. */
  std::string hash_of(unsigned file) const;

  /**
   * The file in the folder for "O1000" (only the number counts, so `o1000.NC` and `O01000` match, too, with or without an
   * ending) or for the name between < > (first with the same spelling, then in any case). "" when there is none. The folder
   * is read each time, because a control runs for months, and programs come and go.
   */
  std::string find(const std::string& name) const;
  /** The same for a program in another folder, as nc_program_missing names it: "198:O5", "D1:<name>". */
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
  std::function<bool()> stop_;
  std::function<void(unsigned, const std::string&, const Text&)> told_entered_;
  std::function<void(unsigned)> told_dropped_;
  std::vector<std::unique_ptr<Entry>> entries_;
  uint64_t entered_ = 0;
};

}  // namespace nc::tools
