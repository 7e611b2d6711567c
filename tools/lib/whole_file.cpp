// SPDX-License-Identifier: Apache-2.0
// See whole_file.hpp.
#include "tools/lib/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace nc::tools {
namespace {

std::string sentence(const std::string& path, int code) { return path + ": " + std::generic_category().message(code); }

// Where the links of a path lead; the path itself where there is nothing yet.
std::string target_of(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> real(realpath(path.c_str(), nullptr), &std::free);
  return real != nullptr ? real.get() : path;
}

}  // namespace

WholeFile::~WholeFile() {
  if (!beside_.empty()) (void)unlink(beside_.c_str());
}

// A new file beside the place, with the permissions that it has there. False when it has to be written as it is.
bool WholeFile::open_beside(const std::string& path) {
  struct stat info {};
  const bool there = stat(path.c_str(), &info) == 0;
  if (there && (!S_ISREG(info.st_mode) || info.st_nlink != 1 || info.st_uid != geteuid() || access(path.c_str(), W_OK) != 0)) return false;
  if (!there && lstat(path.c_str(), &info) == 0) return false;  // a link to nothing
  const std::string target = target_of(path);
  const std::size_t name = target.rfind('/') + 1;
  std::string beside = target.substr(0, name) + "." + target.substr(name) + ".XXXXXX";
  const int file = mkostemp(beside.data(), O_CLOEXEC);
  if (file < 0) return false;
  const mode_t mask = umask(0);
  (void)umask(mask);
  if (fchmod(file, there ? info.st_mode & 07777 : 0666 & ~mask) == 0) file_.reset(fdopen(file, "wb"));
  if (file_ == nullptr) {
    (void)close(file);
    (void)unlink(beside.c_str());
    return false;
  }
  path_ = target;
  beside_ = std::move(beside);
  return true;
}

bool WholeFile::open(const std::string& path, std::string* error) {
  path_ = path;
  if (open_beside(path)) return true;
  file_.reset(std::fopen(path.c_str(), "wbe"));
  if (file_ == nullptr) *error = sentence(path, errno);
  return file_ != nullptr;
}

bool WholeFile::commit(std::string* error) {
  bool good = std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
  if (good && !beside_.empty()) good = fsync(fileno(file_.get())) == 0 && rename(beside_.c_str(), path_.c_str()) == 0;
  if (!good) *error = sentence(path_, errno != 0 ? errno : EIO);
  if (good) beside_.clear();
  file_.reset();
  return good;
}

}  // namespace nc::tools
