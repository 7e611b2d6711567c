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
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

namespace nc::tools {

struct ProgramFiles::OpenFile {
  int descriptor = -1;
  unsigned index = 0;
  uint64_t begin = 0;  // of the text, behind a byte order mark
  std::string path;

  OpenFile() = default;
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor >= 0) close(descriptor);
  }
};

namespace {

constexpr char kExternal[] = "198:";  // before the names of programs that M198 calls

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool equal_any_case(const std::string& a, const std::string& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return lower(x) == lower(y); });
}

// Number of a name `O<digits>` or `O<digits>.<ending>` in any case. At most 9 digits: no O number has more
// than 8.
std::optional<unsigned long> program_number(const std::string& name) {
  if (name.size() < 2 || lower(name[0]) != 'o') return std::nullopt;
  size_t end = 1;
  unsigned long number = 0;
  while (end < name.size() && name[end] >= '0' && name[end] <= '9') {
    number = number * 10 + static_cast<unsigned long>(name[end] - '0');
    if (++end > 10) return std::nullopt;
  }
  if (end == 1 || (end < name.size() && name[end] != '.')) return std::nullopt;
  return number;
}

std::string base_name(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  return slash == std::string::npos || slash + 1 == path.size() ? path : path.substr(slash + 1);
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
             readdir(folder)) {  // NOLINT(concurrency-mt-unsafe): the stream is this function's own
    if (entry->d_name[0] != '.') listing.emplace_back(entry->d_name);
  }
  closedir(folder);
  std::sort(listing.begin(), listing.end());
  return listing;
}

}  // namespace

ProgramFiles::ProgramFiles(std::string folder) : folder_(std::move(folder)) {}
ProgramFiles::~ProgramFiles() = default;

nc_status ProgramFiles::add(nc_control* control, const std::string& path, unsigned* file,
                            std::string* error) {
  // Non-blocking open: a FIFO must give an error below, not hang here.
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    if (error) *error = path + ": " + std::generic_category().message(errno);
    return NC_E_READ;
  }
  const nc_status status = add_descriptor(control, descriptor, base_name(path), file, error);
  if (status == NC_OK) files_.back()->path = path;
  return status;
}

nc_status ProgramFiles::add_descriptor(nc_control* control, int descriptor, const std::string& name,
                                       unsigned* file, std::string* error) {
  auto entry = std::make_unique<OpenFile>();
  entry->descriptor = descriptor;
  entry->path = name;
  struct stat info = {};
  if (fstat(descriptor, &info) != 0) {
    if (error) *error = name + ": " + std::generic_category().message(errno);
    return NC_E_READ;
  }
  if (!S_ISREG(info.st_mode)) {
    if (error) *error = name + ": " + not_a_program(info.st_mode);
    return NC_E_READ;
  }
  char head[3];
  const long got = read_at(entry.get(), 0, head, sizeof head);
  if (got < 0) {
    if (error) *error = name + ": cannot be read";
    return NC_E_READ;
  }
  entry->begin = mark_length(head, static_cast<size_t>(got));
  const nc_status status = nc_program_add(control, name.c_str(), &ProgramFiles::read_at, entry.get(),
                                          static_cast<uint64_t>(info.st_size) - entry->begin, &entry->index);
  if (status != NC_OK) {
    if (error) *error = name + ": " + reason(status);
    return status;
  }
  if (file) *file = entry->index;
  files_.push_back(std::move(entry));
  return NC_OK;
}

size_t ProgramFiles::mark_length(const char* text, size_t size) {
  return size >= 3 && std::memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
}

void ProgramFiles::attach(nc_control* control) {
  nc_program_on_missing(control, &ProgramFiles::on_missing, this);
}

std::string ProgramFiles::path_of(unsigned file) const {
  // Backwards: an entry that replaced another of the same name has the same index and stands behind it.
  for (auto entry = files_.rbegin(); entry != files_.rend(); ++entry)
    if ((*entry)->index == file) return (*entry)->path;
  return "";
}

long ProgramFiles::read_at(void* user, uint64_t offset, char* buffer, size_t size) {
  const auto* file = static_cast<const OpenFile*>(user);
  size_t got = 0;
  while (got < size) {
    const ssize_t n =
        pread(file->descriptor, buffer + got, size - got, static_cast<off_t>(file->begin + offset + got));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return -1;
    if (n == 0) break;
    got += static_cast<size_t>(n);
  }
  return static_cast<long>(got);
}

std::string ProgramFiles::find(const std::string& name) const {
  if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos) return "";
  const std::vector<std::string> listing = list_folder(folder_);
  const auto number = program_number(name);
  const std::string* loose = nullptr;
  for (const std::string& candidate : listing) {
    if (candidate == name) return folder_ + "/" + candidate;
    const bool fits = number ? program_number(candidate) == number : equal_any_case(candidate, name);
    if (fits && !loose) loose = &candidate;
  }
  return loose ? folder_ + "/" + *loose : "";
}

bool ProgramFiles::on_missing(void* user, nc_control* control, const char* name) {
  auto* self = static_cast<ProgramFiles*>(user);
  // M700 13.3.2: a program of the data server.
  const bool external = std::strncmp(name, kExternal, sizeof kExternal - 1) == 0;
  // M700 13.3.1, M98 ,D1 to ,D4: a folder of its own for each device, in that of the programs.
  const bool device = name[0] == 'D' && name[1] >= '1' && name[1] <= '4' && name[2] == ':';
  const std::string wanted = external ? name + sizeof kExternal - 1 : device ? name + 3 : name;
  const std::string path = device                                 ? ProgramFiles(self->folder_ + "/device" + name[1]).find(wanted)
                           : external && !self->external_.empty() ? ProgramFiles(self->external_).find(wanted)
                                                                  : self->find(wanted);
  if (path.empty()) return false;
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  // Entered under the name that was asked for, whatever the file's spelling.
  if (self->add_descriptor(control, descriptor, name, nullptr, nullptr) != NC_OK) return false;
  self->files_.back()->path = path;
  return true;
}

}  // namespace nc::tools
