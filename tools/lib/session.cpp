// SPDX-License-Identifier: Apache-2.0
// Building a control for a command line; see session.hpp.
#include "tools/lib/session.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "tools/lib/item_source.hpp"
#include "tools/lib/json_check.hpp"

namespace nc::tools {
namespace {

constexpr size_t kAlignment = 64;
constexpr size_t kMaxStandardInput = size_t{1} << 30;

std::string folder_of(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string why_not(nc_status status) {
  switch (status) {
    case NC_E_MEMORY:
      return "not enough memory";
    case NC_E_ARGUMENT:
      return "the configuration is not valid";
    default:
      return "status " + std::to_string(status);
  }
}

}  // namespace

std::optional<nc_dialect> dialect_from_name(const std::string& name) {
  if (name == "m700") return NC_DIALECT_M700;
  if (name == "dgshape") return NC_DIALECT_DGSHAPE;
  return std::nullopt;
}

Session::Session() {
  nc_config_init(&config_);
}
Session::~Session() = default;

void Session::Release::operator()(void* memory) const {
  std::free(memory);
}

bool Session::configure(const SessionOptions& options, std::string* error) {
  const auto dialect = dialect_from_name(options.dialect);
  if (!dialect) {
    *error = "--dialect " + options.dialect + ": this version knows m700 and dgshape";
    return false;
  }
  dialect_ = *dialect;
  if (!options.setup.empty() && !load_setup(options.setup, &setup_, error)) return false;
  nc_config_init(&config_);
  config_.dialect = static_cast<uint8_t>(dialect_);
  apply_setup(setup_, &config_);
  return true;
}

bool Session::start(const SessionOptions& options, std::string* error) {
  const size_t size = nc_memory_required(&config_);
  if (size == 0) {
    *error = setup_.name + ": the control cannot be built with these axes and options";
    return false;
  }
  memory_.reset(std::aligned_alloc(kAlignment, (size + kAlignment - 1) / kAlignment * kAlignment));
  nc_status status = NC_E_MEMORY;
  if (memory_) control_ = nc_create(&config_, memory_.get(), size, &status);
  if (!control_) {
    *error = "the control cannot be created: " + why_not(status);
    return false;
  }
  if (!apply_setup(setup_, dialect_, control_, error)) return false;
  files_ = std::make_unique<ProgramFiles>(options.programs         ? *options.programs
                                          : options.program == "-" ? "."
                                                                   : folder_of(options.program));
  files_->set_external(options.external);
  if (!add_main(options, error)) return false;
  files_->attach(control_);
  status = nc_program_select(control_, kPartSystem, main_file_);
  if (status != NC_OK) {
    *error = main_name_ + ": cannot be selected: " + why_not(status);
    return false;
  }
  return true;
}

bool Session::add_main(const SessionOptions& options, std::string* error) {
  if (options.programs) {
    struct stat info = {};
    if (stat(options.programs->c_str(), &info) != 0 || !S_ISDIR(info.st_mode)) {
      *error = "--programs " + *options.programs + ": not a folder";
      return false;
    }
  }
  main_name_ = options.program;
  if (options.program == "-") return add_standard_input(error);
  return files_->add(control_, options.program, &main_file_, error) == NC_OK;
}

// A file redirected to standard input is read in windows like any other; a pipe is taken in whole.
bool Session::add_standard_input(std::string* error) {
  main_name_ = "<stdin>";
  struct stat info = {};
  if (fstat(STDIN_FILENO, &info) == 0 && S_ISREG(info.st_mode) && lseek(STDIN_FILENO, 0, SEEK_CUR) == 0) {
    const int copy = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
    if (copy >= 0) return files_->add_descriptor(control_, copy, "stdin", &main_file_, error) == NC_OK;
  }
  char buffer[65536];
  for (;;) {
    const ssize_t n = read(STDIN_FILENO, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      *error = main_name_ + ": " + std::generic_category().message(errno);
      return false;
    }
    if (n == 0) break;
    text_.append(buffer, static_cast<size_t>(n));
    if (text_.size() > kMaxStandardInput) {
      *error = main_name_ + ": more than 1 GiB through a pipe; give a file";
      return false;
    }
  }
  text_.erase(0, ProgramFiles::mark_length(text_.data(), text_.size()));
  if (nc_program_add_text(control_, "stdin", text_.data(), text_.size(), &main_file_) == NC_OK) return true;
  *error = main_name_ + ": the program store refused it";
  return false;
}

BlockLines Session::block_lines() const {
  bool wanted = false;
  for (const SetupEvent& event : setup_.events) wanted = wanted || event.line;
  if (!wanted) return {};
  if (!text_.empty()) return BlockLines(text_);
  std::string content, error;
  const std::string path = files_->path_of(main_file_);
  if (!json::read_text_file(path == "stdin" ? "/dev/stdin" : path, &content, &error)) return {};
  content.erase(0, ProgramFiles::mark_length(content.data(), content.size()));
  return BlockLines(content);
}

std::string Session::file_name(const nc_source& source) const {
  if (source.file == main_file_) return main_name_;
  const std::string path = files_->path_of(source.file);
  return path.empty() ? setup_.name + ":O" + std::to_string(source.program) : path;
}

}  // namespace nc::tools
