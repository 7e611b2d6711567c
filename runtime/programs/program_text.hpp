// SPDX-License-Identifier: Apache-2.0
// The text of a program file as it was when the program was selected, or first called; UTF-8, lines ended by line feeds.
//
// Whoever writes into the file meanwhile (an editor, cp, a post processor) must not change what runs: a program half old and half new is
// none that anybody has written. A file of up to Options::copy_bytes is read whole and never looked at again. Of a larger one each part is
// read when it is needed; then size, times and place of the file must be what they were, and a part that is read again must have the hash
// that it had, or the text counts as changed from then on and nothing more of it can be read. Nothing is mapped: a mapped file that is
// truncated ends the process.
//
// A file that is being written just now is no program yet: it is taken when nobody has it open for writing, it has been left alone for
// kQuiet, and two readings of it are the same. Where the system does not tell who has it open (another user's file without CAP_LEASE, which the
// service has; some network file systems) it must have been left alone for kQuietNotTold: a writer who pauses for longer than that in the
// middle of the file cannot be told from one who has finished.
#pragma once

#include <sys/stat.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/programs/encoding.hpp"

namespace nc::rt {

class ProgramText {
 public:
  struct Options {
    Encoding encoding = Encoding::kUtf8;
    std::uint64_t copy_bytes = std::uint64_t{16} << 20;
    bool as_it_is = false;                        // the image of a tape: no text, nothing is converted
    std::chrono::milliseconds patience{2000};     // with a file that is being written
  };
  static constexpr std::chrono::milliseconds kQuiet{20}, kQuietNotTold{1000};
  static constexpr std::size_t kPart = 65536;     // bytes of the file that are read and hashed together

  // Takes the descriptor over, also on failure. `path`: where the file was found; "" = it has no place that could be looked at (standard
  // input). Null on failure, with a sentence that does not name the file.
  static std::shared_ptr<ProgramText> open(int descriptor, const std::string& path, const Options& options, std::string* error);
  // The file at `path`.
  static std::shared_ptr<ProgramText> open_file(const std::string& path, const Options& options, std::string* error);
  ~ProgramText();
  ProgramText(const ProgramText&) = delete;
  ProgramText& operator=(const ProgramText&) = delete;

  std::uint64_t size() const { return size_; }
  bool copied() const { return descriptor_ < 0; }
  // As nc_read_at. Any thread.
  long read(std::uint64_t offset, char* buffer, std::size_t size);
  // The file at this place is the one that was opened, and unchanged as far as size and time tell.
  bool is_file(const struct stat& info) const;
  // What stands at its place now is not that, or nothing is there; never of a text without a place.
  bool has_changed() const;

 private:
  struct Part {
    std::uint64_t file_begin = 0, text_begin = 0;
    std::uint64_t hash = 0;
    bool hashed = false;
  };
  ProgramText(int descriptor, std::string path, const Options& options);
  bool copy(std::string* error);
  bool divide();
  void look_at_head(const std::string& head);
  bool is_unchanged() const;
  bool load(std::size_t part);
  long give_up(long code);
  void finish(std::string* text) const;

  const std::string path_;
  const Options options_;
  struct stat info_ = {};
  int descriptor_;
  std::uint64_t size_ = 0;
  std::size_t mark_ = 0;       // bytes of a byte order mark
  bool cr_ends_line_ = false;
  std::string text_;           // all of it, or the part that was read last
  std::mutex mutex_;           // guards what is below, and text_ where it is a part
  std::vector<Part> parts_;
  std::size_t loaded_ = SIZE_MAX;
  long failure_ = 0;
};

}  // namespace nc::rt
