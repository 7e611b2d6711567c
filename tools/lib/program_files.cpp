// SPDX-License-Identifier: Apache-2.0
// Program files on disk; see program_files.hpp.
#include "tools/lib/program_files.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <utility>

#include "runtime/programs/called_number.hpp"
#include "runtime/services/sha256.hpp"

namespace nc::tools {

struct ProgramFiles::Entry {
  unsigned index = 0;
  std::string path;
  Text text;
  const ProgramFiles* owner = nullptr;
};

namespace {

// How long a sub program that is being written is waited for. It is short, because the machine may be moving: when nothing is read ahead for too long, the
// machine comes to rest.
constexpr std::chrono::milliseconds kPatienceInMotion{300};
constexpr char kExternal[] = "198:";  // prefix of the names of programs that M198 calls

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool equal_any_case(const std::string& a, const std::string& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string base_name(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  return slash == std::string::npos || slash + 1 == path.size() ? path : path.substr(slash + 1);
}

// What stands for the content of a file that is too large to be read whole while an operator waits: with another content it is another one, and with the same content
// it is another one only where the file was written anew or its permissions were changed.
std::string identity_text(const struct stat& info) {
  std::string text = "file";
  for (const long long part : {static_cast<long long>(info.st_size), static_cast<long long>(info.st_ino), static_cast<long long>(info.st_mtim.tv_sec), static_cast<long long>(info.st_mtim.tv_nsec),
                               static_cast<long long>(info.st_ctim.tv_sec), static_cast<long long>(info.st_ctim.tv_nsec)})
    text += ' ' + std::to_string(part);
  return text;
}

// Opens without blocking: a FIFO must give an error and must not block here.
int open_file(const std::string& path) {
  return open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

const char* not_a_program(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder, not a program";
  if (S_ISFIFO(mode))
    return "is a pipe; a program is read in windows: give a file, or ncsim its standard input (-)";
  return "is not a regular file";
}

std::string reason(nc_status status) {
  switch (status) {
    case NC_E_ARGUMENT:
      return "the name cannot be a program's name";
    case NC_E_MEMORY:
      return "the program store is full";
    case NC_E_STATE:
      return "it runs, or is protected (parameters 8105 and 1121)";
    case NC_E_READ:
      return "cannot be read";
    default:
      return "the program store refused it";
  }
}

// Names in a folder, sorted, so that the choice between two candidates is always the same.
std::vector<std::string> list_folder(const std::string& path) {
  std::vector<std::string> listing;
  DIR* folder = path.empty() ? nullptr : opendir(path.c_str());
  if (!folder) return listing;
  while (const dirent* entry =
             readdir(folder)) {  // NOLINT(concurrency-mt-unsafe): only this function uses the stream
    if (entry->d_name[0] != '.') listing.emplace_back(entry->d_name);
  }
  closedir(folder);
  std::sort(listing.begin(), listing.end());
  return listing;
}

}  // namespace

ProgramFiles::ProgramFiles(std::string folder, const rt::ProgramText::Options& options)
    : folder_(std::move(folder)), options_(options) {}
ProgramFiles::~ProgramFiles() = default;

nc_status ProgramFiles::add(nc_control* control, const std::string& path, unsigned* file, std::string* error, bool tape) {
  give_up_unused(control);
  const int descriptor = open_file(path);
  if (descriptor < 0) {
    if (error) *error = path + ": " + std::generic_category().message(errno);
    return NC_E_READ;
  }
  rt::ProgramText::Options options = options_;
  options.as_it_is = tape;
  return enter(control, descriptor, path, base_name(path), options, file, error);
}

nc_status ProgramFiles::add_descriptor(nc_control* control, int descriptor, const std::string& name, unsigned* file,
                                       std::string* error, bool tape) {
  give_up_unused(control);
  rt::ProgramText::Options options = options_;
  options.as_it_is = tape;
  return enter(control, descriptor, "", name, options, file, error);
}

nc_status ProgramFiles::enter(nc_control* control, int descriptor, const std::string& path, const std::string& name,
                              const rt::ProgramText::Options& options, unsigned* file, std::string* error) {
  const std::string& shown = path.empty() ? name : path;
  std::string why;
  struct stat info = {};
  const char* unfit = fstat(descriptor, &info) == 0 && !S_ISREG(info.st_mode) ? not_a_program(info.st_mode) : nullptr;
  if (unfit) close(descriptor);
  auto made = std::make_unique<Entry>();
  made->path = shown;
  made->owner = this;
  if (!unfit) made->text = rt::ProgramText::open(descriptor, path, options, &why);
  if (!made->text) {
    if (error) *error = shown + ": " + (unfit ? unfit : why);
    return NC_E_READ;
  }
  nc_status status = NC_E_MEMORY;
  do {
    status = nc_program_add(control, name.c_str(), &ProgramFiles::read_at, made.get(), made->text->size(), &made->index);
  } while (status == NC_E_MEMORY && make_room(control));
  if (status != NC_OK) {
    // The program is protected and already in the store, from the same unchanged file: that one is used.
    for (const auto& there : entries_) {
      if (status != NC_E_STATE || there->path != shown || !there->text->is_file(info)) continue;
      if (file) *file = there->index;
      return NC_OK;
    }
    if (error) *error = shown + ": " + reason(status);
    return status;
  }
  forget(made->index);  // the program that it has replaced
  if (file) *file = made->index;
  entries_.push_back(std::move(made));
  ++entered_;
  if (told_entered_) told_entered_(entries_.back()->index, shown, entries_.back()->text);
  return NC_OK;
}

std::vector<std::pair<std::string, ProgramFiles::Text>> ProgramFiles::texts() const {
  std::vector<std::pair<std::string, Text>> all;
  for (const auto& entry : entries_) all.emplace_back(entry->path, entry->text);
  return all;
}

std::string ProgramFiles::changed() const {
  std::string names;
  for (const auto& entry : entries_)
    if (entry->text->has_changed()) names += (names.empty() ? "" : ", ") + base_name(entry->path);
  return names;
}

void ProgramFiles::forget(unsigned file) {
  std::erase_if(entries_, [&](const std::unique_ptr<Entry>& entry) { return entry->index == file; });
}

// Protected ones as well: a parameter protects a program from those who operate the control, and what runs is always what the file has.
void ProgramFiles::give_up_unused(nc_control* control) {
  std::erase_if(entries_, [&](const std::unique_ptr<Entry>& entry) {
    if ((remembered_ && remembered_(entry->index)) || nc_program_give_up(control, entry->index) != NC_OK) return false;
    if (told_dropped_) told_dropped_(entry->index);
    return true;
  });
}

// Removes one program: of those to which nothing refers the one whose last use is longest ago.
bool ProgramFiles::make_room(nc_control* control) {
  const Entry* oldest = nullptr;
  uint64_t used = 0;
  for (const auto& entry : entries_) {
    nc_program_info info;
    if (nc_program_get(control, entry->index, &info) != NC_OK || info.in_use) continue;
    if ((remembered_ && remembered_(entry->index)) || (oldest && info.used > used)) continue;
    oldest = entry.get();
    used = info.used;
  }
  if (!oldest || nc_program_give_up(control, oldest->index) != NC_OK) return false;
  const unsigned file = oldest->index;
  forget(file);
  if (told_dropped_) told_dropped_(file);
  return true;
}

void ProgramFiles::attach(nc_control* control) {
  nc_program_on_missing(control, &ProgramFiles::on_missing, this);
}

const ProgramFiles::Entry* ProgramFiles::entry(unsigned file) const {
  for (const auto& entry : entries_)
    if (entry->index == file) return entry.get();
  return nullptr;
}

std::string ProgramFiles::path_of(unsigned file) const {
  const Entry* found = entry(file);
  return found ? found->path : "";
}

ProgramFiles::Text ProgramFiles::text_of(unsigned file) const {
  const Entry* found = entry(file);
  return found ? found->text : nullptr;
}

std::string ProgramFiles::hash_of(unsigned file) const {
  const Text text = text_of(file);
  if (text == nullptr) return "";
  rt::services::Sha256 sum;
  if (!text->copied()) {
    sum.add(identity_text(text->info()));
    return sum.finish();
  }
  std::string bytes(rt::ProgramText::kPart, '\0');
  for (uint64_t at = 0; at < text->size();) {
    const long count = text->read(at, bytes.data(), bytes.size());
    if (count <= 0) return "";
    sum.add({bytes.data(), static_cast<size_t>(count)});
    at += static_cast<uint64_t>(count);
  }
  return sum.finish();
}

long ProgramFiles::read_at(void* user, uint64_t offset, char* buffer, size_t size) {
  const Entry& entry = *static_cast<const Entry*>(user);
  return entry.owner->stop_ && entry.owner->stop_() ? NC_READ_FAILED : entry.text->read(offset, buffer, size);
}

std::string ProgramFiles::find(const std::string& name) const {
  if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos) return "";
  const std::vector<std::string> listing = list_folder(folder_);
  const auto number = rt::called_number(name);
  const std::string* loose = nullptr;
  for (const std::string& candidate : listing) {
    if (candidate == name) return folder_ + "/" + candidate;
    const bool fits = number ? rt::called_number(candidate) == number : equal_any_case(candidate, name);
    if (fits && !loose) loose = &candidate;
  }
  return loose ? folder_ + "/" + *loose : "";
}

std::string ProgramFiles::find_called(const std::string& name) const {
  // M700 13.3.2: a program of the data server.
  const size_t external = sizeof kExternal - 1;
  if (name.compare(0, external, kExternal) == 0)
    return external_.empty() ? find(name.substr(external)) : ProgramFiles(external_).find(name.substr(external));
  // M700 13.3.1, M98 ,D1 to ,D4: each device has a folder of its own inside the folder of programs.
  const bool device = name.size() > 3 && name[0] == 'D' && name[1] >= '1' && name[1] <= '4' && name[2] == ':';
  return device ? ProgramFiles(folder_ + "/device" + name[1]).find(name.substr(3)) : find(name);
}

bool ProgramFiles::on_missing(void* user, nc_control* control, const char* name) {
  auto* self = static_cast<ProgramFiles*>(user);
  const std::string path = self->find_called(name);
  const int descriptor = path.empty() ? -1 : open_file(path);
  if (descriptor < 0) return false;
  rt::ProgramText::Options options = self->options_;
  options.patience = std::min(options.patience, kPatienceInMotion);
  // The program is entered under the name that was asked for, even if the name of the file is spelled differently.
  std::string error;
  const nc_status status = self->enter(control, descriptor, path, name, options, nullptr, &error);
  if (status != NC_OK && self->report_) self->report_(error);
  return status == NC_OK;
}

}  // namespace nc::tools
