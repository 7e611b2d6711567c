// SPDX-License-Identifier: Apache-2.0
// See program_store.hpp.
#include "runtime/services/program_store.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "runtime/programs/called_number.hpp"

namespace nc::rt::services {
namespace {

constexpr char kHidden[] = ".nc-upload-";
constexpr mode_t kPermissions = 0664;
constexpr std::uint64_t kDefaultCount = 500;

std::uint64_t whole(const Call& call, Field field, std::uint64_t other = 0) {
  return call.has(field) ? static_cast<std::uint64_t>(call.value(field)) : other;
}

// 64 hexadecimal digits in any case, made those in which the sum is written here.
bool read_digest(const std::string& text, std::string* digest) {
  constexpr std::size_t kHashDigits = 64;
  digest->clear();
  for (const char c : text) {
    if ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f')) digest->push_back(c);
    else if (c >= 'A' && c <= 'F') digest->push_back(static_cast<char>(c - 'A' + 'a'));
    else return false;
  }
  return digest->size() == kHashDigits;
}

Outcome failed(const std::string& what) {
  const int code = errno;
  if (code == ENOSPC || code == EDQUOT) return Outcome::refused(Refused::kNoSpace, what + ": the disk is full");
  if (code == ELOOP) return Outcome::refused(Refused::kNotFound, what + ": is a link, and no program");
  if (code == ENOENT) return Outcome::refused(Refused::kNotFound, what + ": there is no such program");
  return Outcome::refused(Refused::kFailed, what + ": " + std::strerror(code));
}

std::int64_t modified_ns(const struct stat& info) {
  return std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
}

bool is_protected(const struct stat& info) { return (info.st_mode & S_IWUSR) == 0; }

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The regular files in the folder with names that a program may have, sorted. A file with another name cannot be asked for, and is not a program.
std::vector<std::pair<std::string, struct stat>> files_in(int folder) {
  std::vector<std::pair<std::string, struct stat>> files;
  const int copy = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* stream = copy >= 0 ? fdopendir(copy) : nullptr;
  if (stream == nullptr) {
    if (copy >= 0) close(copy);
    return files;
  }
  while (const dirent* entry = readdir(stream)) {  // NOLINT(concurrency-mt-unsafe): only this function uses the stream
    struct stat info {};
    if (is_program_name(entry->d_name) && fstatat(folder, entry->d_name, &info, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(info.st_mode))
      files.emplace_back(entry->d_name, info);
  }
  closedir(stream);
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return files;
}

// A descriptor that is closed at the end.
struct Held {
  int number = -1;
  explicit Held(int descriptor) : number(descriptor) {}
  ~Held() {
    if (number >= 0) close(number);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
};

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool sync_folder(int folder) {
  const Held copy(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return copy.number >= 0 && (fsync(copy.number) == 0 || errno == EINVAL);  // some file systems cannot sync a folder
}

}  // namespace

ProgramStore::~ProgramStore() {
  while (!uploads_.empty()) drop(uploads_.begin()->first);
}

int ProgramStore::open_folder() const {
  return ::open(folder_.empty() ? "." : folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
}

void ProgramStore::clean() {
  const Held folder(open_folder());
  const Held copy(folder.number < 0 ? -1 : openat(folder.number, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  DIR* stream = copy.number >= 0 ? fdopendir(dup(copy.number)) : nullptr;
  if (stream == nullptr) return;
  while (const dirent* entry = readdir(stream))  // NOLINT(concurrency-mt-unsafe): only this function uses the stream
    if (std::strncmp(entry->d_name, kHidden, sizeof kHidden - 1) == 0) (void)unlinkat(folder.number, entry->d_name, 0);
  closedir(stream);
}

std::uint64_t ProgramStore::used_bytes(int folder) const {
  std::uint64_t bytes = 0;
  for (const auto& [name, info] : files_in(folder)) bytes += static_cast<std::uint64_t>(info.st_size);
  for (const auto& [number, upload] : uploads_) bytes += upload.size;
  return bytes;
}

Outcome ProgramStore::list(const Call& call) const {
  const Held folder(open_folder());
  if (folder.number < 0) return failed("the folder of programs");
  const auto files = files_in(folder.number);
  Names names;
  for (const auto& [name, info] : files) names.push_back(name);
  const Use use = use_(names);
  const std::uint64_t from = whole(call, Field::kFrom), count = whole(call, Field::kCount, kDefaultCount);
  Json programs = Json::array();
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [name, info] = files[i];
    bytes += static_cast<std::uint64_t>(info.st_size);
    if (i < from || i - from >= count) continue;
    programs.push_back({{"name", name},
                        {"size", info.st_size},
                        {"modified_ns", modified_ns(info)},
                        {"protected", is_protected(info) || contains(use.locked, name)},
                        {"selected", contains(use.selected, name)}});
  }
  return Outcome::with({{"programs", std::move(programs)},
                        {"bytes", bytes},
                        {"most_bytes", limits_.total_bytes},
                        {"most_bytes_of_one", limits_.program_bytes},
                        {"next", from + count < files.size() ? from + count : 0}});
}

Outcome ProgramStore::read(const Call& call) const {
  const Held folder(open_folder());
  const std::string& name = call.words(Field::kFile);
  const Held file(folder.number < 0 ? -1 : openat(folder.number, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (file.number < 0 || fstat(file.number, &info) != 0) return failed(name);
  if (!S_ISREG(info.st_mode)) return Outcome::refused(Refused::kNotFound, name + ": there is no such program");
  std::string bytes(static_cast<std::size_t>(whole(call, Field::kBytes)), '\0');
  const ssize_t count = pread(file.number, bytes.data(), bytes.size(), static_cast<off_t>(whole(call, Field::kBegin)));
  if (count < 0) return failed(name);
  bytes.resize(static_cast<std::size_t>(count));
  return Outcome::with({{"data", to_base64(bytes)}, {"size", info.st_size}, {"modified_ns", modified_ns(info)}});
}

// Whether a program may be written, or get this name. The range of numbers that a parameter protects is closed as a whole: a new program with such a number
// would be called in place of one with another ending.
bool ProgramStore::may_name(const std::string& name, Outcome* outcome) const {
  const Use use = use_({name});
  if (use.known && !contains(use.locked, name)) return true;
  if (!use.known) *outcome = Outcome::refused(Refused::kFailed, "the control does not say which programs its parameters protect");
  else *outcome = Outcome::refused(Refused::kProtected, name + " is protected: a parameter protects its number");
  return false;
}

// The program that is called now and in whose place a call would find a new file of this name: the number counts, whatever the ending, and letters in any case. "" = none.
static std::string hidden_by(const std::string& name, const std::vector<std::string>& called) {
  const auto number = called_number(name);
  const auto is_same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  for (const std::string& other : called)
    if (number ? called_number(other) == number : std::equal(name.begin(), name.end(), other.begin(), other.end(), is_same)) return other;
  return "";
}

// Whether a program that is not there may get this name now: one that runs calls what was checked.
bool ProgramStore::may_appear(const std::string& name, Outcome* outcome) const {
  if (!may_name(name, outcome)) return false;
  const Use use = use_({});
  const std::string hidden = use.active ? hidden_by(name, use.called) : "";
  if (!hidden.empty()) *outcome = Outcome::refused(Refused::kProtected, "a program in execution calls " + hidden + ", and would find " + name + " in its place: reset first");
  return hidden.empty();
}

// Whether an existing program may be changed now. When there is none, whether it may appear.
bool ProgramStore::may_change(int folder, const std::string& name, Outcome* outcome) const {
  struct stat info {};
  if (fstatat(folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) return may_appear(name, outcome);
  if (!may_name(name, outcome)) return false;
  const Use use = use_({});
  if (!S_ISREG(info.st_mode)) *outcome = Outcome::refused(Refused::kProtected, name + " is no program");
  else if (is_protected(info)) *outcome = Outcome::refused(Refused::kProtected, name + " is protected");
  else if (use.active && contains(use.selected, name)) *outcome = Outcome::refused(Refused::kProtected, name + " is in execution: reset first");
  else if (use.active && contains(use.called, name)) *outcome = Outcome::refused(Refused::kProtected, name + " is called by a program in execution: reset first");
  else if (use.active && static_cast<std::uint64_t>(info.st_size) > limits_.copy_bytes)
    *outcome = Outcome::refused(Refused::kProtected, name + " is so large that a program in execution reads it from its file: reset first");
  else return true;
  return false;
}

Outcome ProgramStore::begin(std::uint64_t session, const Call& call) {
  const std::string& name = call.words(Field::kFile);
  const std::uint64_t size = whole(call, Field::kSize);
  std::string digest;
  if (!read_digest(call.words(Field::kHash), &digest)) return Outcome::refused(Refused::kMalformed, "the SHA-256 is not 64 hexadecimal digits");
  if (size > limits_.program_bytes)
    return Outcome::refused(Refused::kNoSpace, "a program may have " + std::to_string(limits_.program_bytes) + " bytes, not " + std::to_string(size));
  drop_silent();
  if (uploads_.size() >= kUploads) return Outcome::refused(Refused::kBusy, std::to_string(kUploads) + " programs are being written already");
  const Held folder(open_folder());
  if (folder.number < 0) return failed("the folder of programs");
  Outcome outcome;
  if (!may_change(folder.number, name, &outcome)) return outcome;
  const bool replace = call.has(Field::kReplace) && call.flag(Field::kReplace);
  if (!replace && faccessat(folder.number, name.c_str(), F_OK, AT_SYMLINK_NOFOLLOW) == 0)
    return Outcome::refused(Refused::kProtected, name + " is there already: replace it, or take another name");
  if (const std::uint64_t used = used_bytes(folder.number); used > limits_.total_bytes || size > limits_.total_bytes - used)
    return Outcome::refused(Refused::kNoSpace, "all programs together may have " + std::to_string(limits_.total_bytes) + " bytes, and have " + std::to_string(used));
  Upload upload;
  upload.session = session;
  upload.last = std::chrono::steady_clock::now();
  upload.name = name;
  upload.hidden = kHidden + std::to_string(getpid()) + "-" + std::to_string(next_);
  upload.hash = std::move(digest);
  upload.size = size;
  upload.replace = replace;
  upload.file = openat(folder.number, upload.hidden.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kPermissions);
  if (upload.file < 0) return failed(name);
  // The room is taken now, so that a full disk is told before anything is sent. A file system without this function tells it later.
  const bool reserved = size == 0 || fallocate(upload.file, 0, 0, static_cast<off_t>(size)) == 0 || errno == EOPNOTSUPP || errno == ENOSYS;
  const int code = errno;
  const std::uint32_t number = next_++;
  uploads_[number] = std::move(upload);
  if (!reserved) {
    drop(number);
    errno = code;
    return failed(name);
  }
  return Outcome::with({{"upload", number}, {"bytes", kChunkBytes}});
}

ProgramStore::Upload* ProgramStore::find(std::uint64_t session, const Call& call) {
  const auto found = uploads_.find(static_cast<std::uint32_t>(call.value(Field::kUpload)));
  return found == uploads_.end() || found->second.session != session ? nullptr : &found->second;
}

void ProgramStore::drop(std::uint32_t number) {
  const auto found = uploads_.find(number);
  if (found == uploads_.end()) return;
  close(found->second.file);
  const Held folder(open_folder());
  if (folder.number >= 0 && !found->second.hidden.empty()) (void)unlinkat(folder.number, found->second.hidden.c_str(), 0);
  uploads_.erase(found);
}

// Who begins and never goes on keeps neither a place nor room on the disk from others.
void ProgramStore::drop_silent() {
  const auto now = std::chrono::steady_clock::now();
  std::vector<std::uint32_t> numbers;
  for (const auto& [number, upload] : uploads_)
    if (now - upload.last > limits_.silence) numbers.push_back(number);
  for (const std::uint32_t number : numbers) drop(number);
}

Outcome ProgramStore::data(std::uint64_t session, const Call& call) {
  Upload* upload = find(session, call);
  if (upload == nullptr) return Outcome::refused(Refused::kNotFound, "there is no such upload");
  const std::string& bytes = call.words(Field::kData);
  if (whole(call, Field::kBegin) != upload->written)
    return Outcome::refused(Refused::kMalformed, "the next piece begins at " + std::to_string(upload->written));
  if (bytes.size() > upload->size - upload->written) return Outcome::refused(Refused::kMalformed, "more bytes than the size that was given");
  if (!write_all(upload->file, bytes)) {
    const Outcome outcome = failed(upload->name);
    drop(static_cast<std::uint32_t>(call.value(Field::kUpload)));
    return outcome;
  }
  upload->written += bytes.size();
  upload->last = std::chrono::steady_clock::now();
  upload->sum.add(bytes);
  return Outcome::with({{"begin", upload->written}});
}

Outcome ProgramStore::finish(std::uint64_t session, const Call& call, std::string* name) {
  Upload* upload = find(session, call);
  if (upload == nullptr) return Outcome::refused(Refused::kNotFound, "there is no such upload");
  const auto number = static_cast<std::uint32_t>(call.value(Field::kUpload));
  *name = upload->name;
  const Held folder(open_folder());
  Outcome outcome = Outcome::done();
  if (folder.number < 0) {
    outcome = failed("the folder of programs");
  } else if (upload->written != upload->size) {
    return Outcome::refused(Refused::kMalformed, std::to_string(upload->size - upload->written) + " bytes are missing");
  } else if (Sha256 sum = upload->sum; sum.finish() != upload->hash) {
    outcome = Outcome::refused(Refused::kMalformed, "the SHA-256 is another one: something was changed on its way");
  } else if (may_change(folder.number, upload->name, &outcome)) {
    const unsigned flags = upload->replace ? 0 : RENAME_NOREPLACE;
    if (fsync(upload->file) != 0) outcome = failed(upload->name);
    else if (renameat2(folder.number, upload->hidden.c_str(), folder.number, upload->name.c_str(), flags) != 0)
      outcome = errno == EEXIST ? Outcome::refused(Refused::kProtected, upload->name + " is there already") : failed(upload->name);
    else upload->hidden.clear();
    if (upload->hidden.empty() && !sync_folder(folder.number)) outcome = failed(upload->name);
  }
  drop(number);
  return outcome;
}

Outcome ProgramStore::abandon(std::uint64_t session, const Call& call) {
  if (find(session, call) == nullptr) return Outcome::refused(Refused::kNotFound, "there is no such upload");
  drop(static_cast<std::uint32_t>(call.value(Field::kUpload)));
  return Outcome::done();
}

void ProgramStore::abandon_all(std::uint64_t session) {
  std::vector<std::uint32_t> numbers;
  for (const auto& [number, upload] : uploads_)
    if (upload.session == session) numbers.push_back(number);
  for (const std::uint32_t number : numbers) drop(number);
}

Outcome ProgramStore::rename(const Call& call) {
  const std::string &name = call.words(Field::kFile), &to = call.words(Field::kNewName);
  const Held folder(open_folder());
  if (folder.number < 0) return failed("the folder of programs");
  Outcome outcome;
  if (!may_change(folder.number, name, &outcome) || !may_appear(to, &outcome)) return outcome;
  if (renameat2(folder.number, name.c_str(), folder.number, to.c_str(), RENAME_NOREPLACE) != 0)
    return errno == EEXIST ? Outcome::refused(Refused::kProtected, to + " is there already") : failed(name);
  return sync_folder(folder.number) ? Outcome::done() : failed(name);
}

Outcome ProgramStore::remove(const Call& call) {
  const std::string& name = call.words(Field::kFile);
  const Held folder(open_folder());
  if (folder.number < 0) return failed("the folder of programs");
  Outcome outcome;
  if (!may_change(folder.number, name, &outcome)) return outcome;
  if (unlinkat(folder.number, name.c_str(), 0) != 0 || !sync_folder(folder.number)) return failed(name);
  return Outcome::done();
}

Outcome ProgramStore::protect(const Call& call) {
  const std::string& name = call.words(Field::kFile);
  const Held folder(open_folder());
  const Held file(folder.number < 0 ? -1 : openat(folder.number, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (file.number < 0 || fstat(file.number, &info) != 0) return failed(name);
  if (!S_ISREG(info.st_mode)) return Outcome::refused(Refused::kNotFound, name + ": there is no such program");
  constexpr mode_t kWrite = S_IWUSR | S_IWGRP | S_IWOTH, kBits = 07777;
  const mode_t mode = call.flag(Field::kOn) ? info.st_mode & kBits & ~kWrite : (info.st_mode & kBits) | S_IWUSR | S_IWGRP;
  return fchmod(file.number, mode) == 0 && fsync(file.number) == 0 ? Outcome::done() : failed(name);
}

}  // namespace nc::rt::services
