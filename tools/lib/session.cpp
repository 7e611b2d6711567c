// SPDX-License-Identifier: Apache-2.0
// Builds a control for a command line; see session.hpp.
#include "tools/lib/session.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <system_error>
#include <utility>

#include "tools/lib/item_source.hpp"
#include "tools/lib/json_check.hpp"

namespace nc::tools {
namespace {

constexpr size_t kMaxStandardInput = size_t{1} << 30;

std::string folder_of(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

bool write_all(int descriptor, const char* bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    const ssize_t n = write(descriptor, bytes + done, size - done);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) done += static_cast<size_t>(n);
  }
  return true;
}

// Copies standard input into a file in memory and returns its descriptor; negative on failure.
int spool_standard_input(std::string* error) {
  const int file = memfd_create("stdin", MFD_CLOEXEC);
  const auto failed = [&](const std::string& why) {
    *error = why;
    if (file >= 0) close(file);
    return -1;
  };
  if (file < 0) return failed(std::generic_category().message(errno));
  char buffer[65536];
  size_t size = 0;
  for (;;) {
    const ssize_t n = read(STDIN_FILENO, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return failed(std::generic_category().message(errno));
    if (n == 0) return file;
    size += static_cast<size_t>(n);
    if (size > kMaxStandardInput) return failed("more than 1 GiB through a pipe; give a file");
    if (!write_all(file, buffer, static_cast<size_t>(n))) return failed(std::generic_category().message(errno));
  }
}

// The values of a machine in the form of a setup, as defaults for what the setup does not name.
Setup setup_of(const rt::Config& machine) {
  Setup setup;
  const nc_system_config& system = machine.nc.system[0];
  setup.axes.clear();
  for (unsigned i = 0; i < system.axis_count; ++i) setup.axes.push_back({system.axis[i].name, system.axis[i].rotary});
  setup.start = machine.start[0];
  setup.option_variable_sets = machine.nc.variable_sets;
  setup.option_tool_offsets = machine.nc.tool_offsets;
  setup.option_work_offsets = machine.nc.work_offsets;
  setup.option_extended_variables = machine.nc.extended_variables;
  std::copy(std::begin(machine.nc.variable_ranges), std::end(machine.nc.variable_ranges), setup.option_variable_ranges);
  return setup;
}

bool same_axes(const Setup& a, const Setup& b) {
  return std::equal(a.axes.begin(), a.axes.end(), b.axes.begin(), b.axes.end(),
                    [](const SetupAxis& x, const SetupAxis& y) { return x.name == y.name && x.rotary == y.rotary; });
}

}  // namespace

Session::Session() {
  nc_config_init(&config_);
}
Session::~Session() = default;

bool Session::configure(const SessionOptions& options, std::string* error, std::unique_ptr<rt::Config> machine) {
  const auto dialect = dialect_from_name(options.dialect);
  if (!dialect) {
    *error = no_dialect(options.dialect);
    return false;
  }
  dialect_ = *dialect;
  machine_ = std::move(machine);
  if (machine_ && !options.dialect_given) dialect_ = static_cast<nc_dialect>(machine_->nc.dialect);
  if (machine_ && machine_->nc.dialect != static_cast<uint8_t>(dialect_)) {
    *error = "--dialect " + options.dialect + ": " + machine_->file + " is a machine of another dialect";
    return false;
  }
  Setup defaults = machine_ ? setup_of(*machine_) : Setup();
  defaults.dialect = dialect_;
  setup_ = defaults;
  if (!options.setup.empty() && !load_setup(options.setup, &setup_, error, defaults)) return false;
  if (machine_ && !same_axes(setup_, defaults)) {
    *error = setup_.name + ": axes: are not those of " + machine_->file;
    return false;
  }
  nc_config_init(&config_);
  if (machine_) config_ = machine_->nc;
  config_.dialect = static_cast<uint8_t>(dialect_);
  apply_setup(setup_, &config_);
  return true;
}

bool Session::start(const SessionOptions& options, std::string* error) {
  nc_config_fault fault;
  if (nc_config_check(&config_, &fault) != NC_OK) {
    *error = setup_.name + ": the control refuses " + fault.field + ": " + fault.reason;
    return false;
  }
  const size_t size = nc_memory_required(&config_);
  nc_status status = NC_E_MEMORY;
  if (void* memory = memory_.allocate(size); memory != nullptr) control_ = nc_create(&config_, memory, size, &status);
  if (!control_) {
    *error = std::string("the control cannot be created: ") + nc_status_text(status);
    return false;
  }
  if (!apply_machine(error) || !apply_setup(setup_, control_, error)) return false;
  if (options.semicolon_comments && nc_parameter_set(control_, kPartSystem, "semicolon_comments", 0, "1") != NC_OK) {
    *error = "--semicolon-comments: ';' is no character of this dialect";
    return false;
  }
  if (machine_) text_ = machine_->program_text;
  if (!machine_ || options.encoding_given) text_.encoding = options.encoding;
  files_ = std::make_unique<ProgramFiles>(options.programs         ? *options.programs
                                          : options.program == "-" ? "."
                                                                   : folder_of(options.program),
                                          text_);
  files_->set_external(options.external);
  if (!add_main(options, error) || !declare_tape(options, error)) return false;
  files_->attach(control_);
  status = nc_program_select(control_, kPartSystem, main_file_);
  if (status != NC_OK) {
    *error = main_name_ + ": cannot be selected: " + nc_status_text(status);
    return false;
  }
  return true;
}

// To be called before the setup is applied, which may change values of the machine.
bool Session::apply_machine(std::string* error) {
  if (!machine_) return true;
  const std::vector<rt::ConfigError> errors = rt::apply_config(*machine_, control_);
  if (errors.empty()) return true;
  *error = errors.front().text();
  return false;
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
  given_ = options.text ? &*options.text : nullptr;
  if (options.text) return nc_program_add_text(control_, options.program.c_str(), options.text->data(), options.text->size(), &main_file_) == NC_OK;
  if (options.program == "-") return add_standard_input(!options.tape.empty(), error);
  return files_->add(control_, options.program, &main_file_, error, !options.tape.empty()) == NC_OK;
}

bool Session::declare_tape(const SessionOptions& options, std::string* error) {
  if (options.tape.empty()) return true;
  constexpr unsigned kUnit = 1;  // the first input device: its parameters are #91nn
  const nc_tape code = options.tape == "iso" ? NC_TAPE_ISO : options.tape == "eia" ? NC_TAPE_EIA : NC_TAPE_TEXT;
  const nc_status status = nc_program_tape(control_, main_file_, static_cast<uint8_t>(code), kUnit);
  if (status != NC_OK) *error = main_name_ + ": cannot be read as a tape: " + nc_status_text(status);
  return status == NC_OK;
}

// A file that is redirected to standard input is read like any other one; a pipe is copied into a file without a name first.
bool Session::add_standard_input(bool tape, std::string* error) {
  main_name_ = "<stdin>";
  struct stat info = {};
  int descriptor = -1;
  if (fstat(STDIN_FILENO, &info) == 0 && S_ISREG(info.st_mode) && lseek(STDIN_FILENO, 0, SEEK_CUR) == 0)
    descriptor = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  if (descriptor < 0 && (descriptor = spool_standard_input(error)) < 0) {
    *error = main_name_ + ": " + *error;
    return false;
  }
  return files_->add_descriptor(control_, descriptor, "stdin", &main_file_, error, tape) == NC_OK;
}

std::string_view Session::main_text() const {
  if (given_ != nullptr) return *given_;
  const ProgramFiles::Text text = files_->text_of(main_file_);
  return text == nullptr ? std::string_view() : text->whole();
}

Decides Session::decides() const {
  return [this] { return has_decision(main_text()); };
}

std::string Session::file_name(const nc_source& source) const {
  if (source.file == main_file_) return main_name_;
  const std::string path = files_->path_of(source.file);
  return path.empty() ? setup_.name + ":O" + std::to_string(source.program) : path;
}

}  // namespace nc::tools
