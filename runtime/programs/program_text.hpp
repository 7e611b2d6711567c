// SPDX-License-Identifier: Apache-2.0
// The text of a program file as it was when the program was selected or first called, in UTF-8 with lines that end with a line feed.
//
// A writer that changes the file meanwhile (an editor, cp, a post processor) must not change the program that runs: half of the old text with half of
// the new one is a program that nobody has written. A file of up to Options::copy_bytes is read whole and not looked at again. Of a larger file each
// part is read when it is needed. At that moment the size, times and place of the file must be unchanged, and a part that is read again must have the
// same hash as before. Otherwise the text counts as changed, and nothing more of it can be read. Nothing of it is read when it is opened, in whatever encoding it is: in
// gigabytes that takes longer than an operator waits. The file is not mapped into memory, because truncating a mapped file would end the process.
//
// A file that is being written is not a complete program. It is taken only when no process has it open for writing, it has been unchanged for
// kQuiet, and its times are the same behind the reading. Of a small one that has been unchanged for less than kCoarse two readings must be the same as well, because
// some file systems have times of two seconds. Where the system does not tell whether it is open for writing (a file of another user, unless
// the process has CAP_LEASE, as the service has; some network file systems) it must have been unchanged for kQuietNotTold, and a small one is read twice in any case. A writer that pauses longer than
// that in the middle of the file cannot be distinguished from one that has finished.
#pragma once

#include <sys/stat.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/programs/encoding.hpp"

namespace nc::rt {

// Whether a file is the one that it was, unchanged. Compares also the time of the last change of the inode: a program such as cp -p or touch can set back the
// time of the content, but not this one.
bool same_content(const struct stat& a, const struct stat& b);

class ProgramText {
 public:
  struct Options {
    Encoding encoding = Encoding::kUtf8;
    std::uint64_t copy_bytes = std::uint64_t{16} << 20;
    std::uint64_t most_bytes = UINT64_MAX;        // a longer file is no program
    bool as_it_is = false;                        // the file is the image of a tape, not a text, and is not converted
    std::chrono::milliseconds patience{2000};     // how long open() waits for a file that is being written
  };
  static constexpr std::chrono::milliseconds kQuiet{20}, kQuietNotTold{1000}, kCoarse{3000};
  static constexpr std::size_t kPart = 65536;     // bytes of the file that are read and hashed together

  // Takes over the descriptor and closes it even on failure. `path`: where the file was found; "" = it has no path at which it could be compared later
  // (standard input). Null on failure, with a sentence in *error that does not name the file.
  static std::shared_ptr<ProgramText> open(int descriptor, const std::string& path, const Options& options, std::string* error);
  // The file at `path`.
  static std::shared_ptr<ProgramText> open_file(const std::string& path, const Options& options, std::string* error);
  ~ProgramText();
  ProgramText(const ProgramText&) = delete;
  ProgramText& operator=(const ProgramText&) = delete;

  std::uint64_t size() const { return size_; }  // of one that is converted and not copied the most that it can have: read() gives 0 behind its end
  // Of the file, as it was opened.
  const struct stat& info() const { return info_; }
  bool copied() const { return descriptor_ < 0; }
  // The whole text of a file that was copied, as long as this object lives; of another one "".
  std::string_view whole() const { return copied() ? std::string_view(text_) : std::string_view(); }
  // As nc_read_at. Any thread.
  long read(std::uint64_t offset, char* buffer, std::size_t size);
  // True when `info` is that of the file that was opened, unchanged as far as its size and times tell.
  bool is_file(const struct stat& info) const;
  // True when another file or a changed one is at the path now, or none. Always false for a text without a path.
  bool has_changed() const;

 private:
  struct Part {
    std::uint64_t file_begin = 0, text_begin = 0;
    std::uint64_t hash = 0;
    bool hashed = false;
  };
  ProgramText(int descriptor, std::string path, const Options& options);
  bool copy(bool doubtful, std::string* error);
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
  std::string text_;           // the whole text, or of a large file the part that was read last
  std::mutex mutex_;           // guards the members below, and text_ when it is a part
  std::vector<Part> parts_;  // those that are known, and where they end
  std::size_t loaded_ = SIZE_MAX;
  long failure_ = 0;
};

}  // namespace nc::rt
