// SPDX-License-Identifier: Apache-2.0
// A file that is written as a whole or not at all: until it is whole and on the disk there is what was there before, on a full disk, too.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace nc::tools {

/** A plain file is written beside its place and renamed. What is none (a device, a pipe), has several names or belongs to another user is written as it is, and so is a file in a
 *  folder that takes no other one. */
class WholeFile {
 public:
  WholeFile() = default;
  ~WholeFile();  // removes what was not committed
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /** @return false with a sentence in *error when nothing can be written there. */
  bool open(const std::string& path, std::string* error);
  std::FILE* stream() const { return file_.get(); }
  /** Brings it to the disk and in its place. @return false with a sentence in *error when it is not whole. */
  bool commit(std::string* error);

 private:
  struct Close {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  bool open_beside(const std::string& path);
  std::string path_, beside_;  // beside_: "" = it is written as it is
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace nc::tools
