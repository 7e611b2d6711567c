// SPDX-License-Identifier: Apache-2.0
// A control with a setup and a program, ready to run. Every subcommand of ncsim that runs a program begins with one.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "nc/nc.h"
#include "runtime/config.hpp"
#include "tools/lib/control_memory.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/offline_run.hpp"
#include "tools/lib/program_files.hpp"
#include "tools/lib/setup.hpp"

namespace nc::tools {

/** The options of the command line. */
struct SessionOptions {
  std::string program;  // "-" = standard input
  std::string setup;    // "" = all defaults
  std::string dialect = default_dialect();
  bool semicolon_comments = false;  // text after ';' is a comment
  bool dialect_given = false;  // the command line names the dialect; otherwise that of a machine is used, if there is one
  std::string print;        // file for what programs print (DPRNT); "" = none
  std::string tape;         // text, iso or eia: the program is a tape; "" = a text
  rt::Encoding encoding = rt::Encoding::kUtf8;
  bool encoding_given = false;  // the command line names the encoding; otherwise that of a machine is used, if there is one
  std::string external;     // folder of the programs that M198 calls; "" = that of sub programs
  std::string machine;      // configuration of the machine that the program is for (TOML); "" = none
  std::optional<std::string> programs;  // folder of sub programs; default: the program's own
  std::optional<std::string> text;      // of the main program, instead of what is in its file; must outlive the session
};

/** Owns the memory of the control and everything it refers to. */
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /**
   * Reads the setup and prepares a configuration, which the caller may still change.
   * @param machine null, or a machine whose axes, sizes, parameters, offsets and start position are used for what the setup does not name.
   */
  bool configure(const SessionOptions& options, std::string* error, std::unique_ptr<rt::Config> machine = nullptr);
  /** Creates the control, applies the setup to it, and selects the program. */
  bool start(const SessionOptions& options, std::string* error);

  nc_config& config() { return config_; }
  const nc_config& config() const { return config_; }
  /** The machine that configure() was given. */
  const rt::Config* machine() const { return machine_.get(); }
  const Setup& setup() const { return setup_; }
  nc_control* control() const { return control_; }
  /** Text of the main program, as long as the session lives; "" for one that is too large to be copied. */
  std::string_view main_text() const;
  nc_dialect dialect() const { return dialect_; }
  unsigned main_file() const { return main_file_; }
  /** Says whether the main program has an IF or a WHILE, as long as the session lives; of one that is too large to be copied it says no. */
  Decides decides() const;
  /** The file of a source in the form for messages. */
  std::string file_name(const nc_source& source) const;

 private:
  bool add_main(const SessionOptions& options, std::string* error);
  bool declare_tape(const SessionOptions& options, std::string* error);
  bool add_standard_input(bool tape, std::string* error);

  bool apply_machine(std::string* error);

  std::unique_ptr<rt::Config> machine_;
  Setup setup_;
  nc_config config_;
  nc_dialect dialect_{};
  ControlMemory memory_;
  std::unique_ptr<ProgramFiles> files_;
  nc_control* control_ = nullptr;
  rt::ProgramText::Options text_;
  std::string main_name_;  // for messages
  const std::string* given_ = nullptr;  // text of the main program that did not come from a file
  unsigned main_file_ = 0;
};

}  // namespace nc::tools
