// SPDX-License-Identifier: Apache-2.0
// External output of programs (POPEN, DPRNT, PCLOS; M700 13.5.8) in a file: what a printer or a punch at the port would get.
#pragma once

#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

class PrintFile {
 public:
  /** Opens `path` for appending. @return false with the reason in *error. */
  bool open(const std::string& path, std::string* error);
  bool is_open() const { return file_ != nullptr; }
  /**
   * One output: a line of its own, without the codes that switch a punch on and off; bytes of BPRNT as they are. It is in the file when
   * this returns true.
   */
  bool write(const nc_text& text);
  /** @return false when something could not be written. */
  bool good() const { return error_.empty(); }
  /** The first reason. */
  const std::string& error() const { return error_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::string error_;
};

/** The same where no file is named: lines for a screen, without those that only switch the punch. Safe between two threads. */
class PrintLines {
 public:
  void write(const nc_text& text);
  /** What has come since the last time; of more than 1,000 lines the first ones, and how many are not shown. */
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::size_t left_out_ = 0;
};

}  // namespace nc::tools
