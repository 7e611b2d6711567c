// SPDX-License-Identifier: Apache-2.0
// A small file that survives a power cut: it is written beside the old one, brought to the disk, then renamed. Two
// generations are kept, each with a check sum, so that at whatever moment the power goes, one of them is whole.
//
//   PATH.new   being written       PATH   the last one       PATH.old   the one before
#pragma once

#include <cstdint>
#include <string>

namespace nc::rt {

class RetainStore {
 public:
  explicit RetainStore(std::string path) : path_(std::move(path)) {}
  ~RetainStore();
  RetainStore(const RetainStore&) = delete;
  RetainStore& operator=(const RetainStore&) = delete;

  // Keeps other processes away from the file. False with a sentence in *error.
  bool lock(std::string* error);

  enum class Loaded { kWhole, kOlder, kNothing, kDamaged };
  // Reads the newest whole generation. kOlder: the last generation is damaged or missing, and the one before was read. kNothing: there
  // is no file yet. kDamaged: there are files, and none is whole. A sentence in *error for kOlder and kDamaged. The files are
  // not changed, so another load() has the same result.
  Loaded load(std::string* payload, std::string* error);
  // Renames PATH to PATH.damaged, so that it can be examined. To be called before the first save() after a loss.
  void set_aside();
  // Writes the next generation. False with a sentence in *error; what was there before is still there.
  bool save(const std::string& payload, std::string* error);

  std::uint64_t generation() const { return generation_; }
  const std::string& path() const { return path_; }
  static constexpr std::size_t kMaxPayload = 1u << 20;

 private:
  bool put_in_place();  // PATH becomes PATH.old, PATH.new becomes PATH
  const std::string path_;
  std::uint64_t generation_ = 0;  // generation that was read or written last
  bool newest_is_new_ = false;    // load() has read PATH.new, which is whole but was not renamed before the power went
  int lock_ = -1;
};

}  // namespace nc::rt
