// SPDX-License-Identifier: Apache-2.0
// A small file that survives a power cut: written beside the old one, brought to the disk, then renamed. Two
// generations stay, each under a check sum, so that whatever moment the power goes, one of them is whole.
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
  // The newest whole generation. kOlder: the last one is damaged or missing, this is the one before. kNothing: there
  // is no file yet. kDamaged: there are files, and none is whole. A sentence in *error for kOlder and kDamaged. Changes
  // nothing: the next one finds the same.
  Loaded load(std::string* payload, std::string* error);
  // PATH becomes PATH.damaged, for whoever wants to look. Before the first save() behind a loss.
  void set_aside();
  // False with a sentence in *error; what was there before is there still.
  bool save(const std::string& payload, std::string* error);

  std::uint64_t generation() const { return generation_; }
  const std::string& path() const { return path_; }
  static constexpr std::size_t kMaxPayload = 1u << 20;

 private:
  bool put_in_place();  // PATH becomes PATH.old, PATH.new becomes PATH
  const std::string path_;
  std::uint64_t generation_ = 0;  // of the last one read or written
  bool newest_is_new_ = false;    // what was read last is PATH.new: whole, but its rename did not come to pass
  int lock_ = -1;
};

}  // namespace nc::rt
