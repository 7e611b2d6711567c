// SPDX-License-Identifier: Apache-2.0
// Writes the external output of programs (POPEN, DPRNT, PCLOS; M700 13.5.8) into a file: what a printer or a punch at the port would get.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

class PrintFile {
 public:
  PrintFile() = default;
  ~PrintFile();
  PrintFile(const PrintFile&) = delete;
  PrintFile& operator=(const PrintFile&) = delete;
  /** Opens `path` for appending. @return false with the reason in *error. */
  bool open(const std::string& path, std::string* error);
  bool is_open() const { return file_ >= 0; }
  /**
   * Writes one output as a line, without the codes that switch a punch on and off; bytes of BPRNT are written unchanged. When this returns true, the
   * output is in the file, when it returns false nothing of it is.
   */
  bool write(const nc_text& text);
  /** @return false when something could not be written. */
  bool good() const { return error_.empty(); }
  /** Why writing failed the first time. */
  const std::string& error() const { return error_; }

 private:
  int file_ = -1;
  std::string error_;
};

/** The same when no file is named: lines for a screen, without those that only switch the punch. May be used by two threads at once. */
class PrintLines {
 public:
  void write(const nc_text& text);
  /** The lines since the last call. When there are more than 1,000, the first ones, and how many are not shown. */
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::size_t left_out_ = 0;
};

}  // namespace nc::tools
