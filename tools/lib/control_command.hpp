// SPDX-License-Identifier: Apache-2.0
// The commands of ncctl. Most of them are rows of the table of services: the words of the command are the name of the service, the members that a request must
// have are arguments in the order of the table, the others are options.
#pragma once

#include <cstdio>
#include <string>

#include "tools/lib/service_client.hpp"

namespace nc::tools {

struct ControlCommand {
  std::string socket, control;  ///< where the control is: path of the socket, or its name; both "" = the only one that runs
  RemoteAccess remote;          ///< over DDS in place of the socket
  bool json = false;            ///< replies are printed as JSON, one in a line
  std::string service;          ///< service to be used
  Json args = Json::object();
  enum class What { kService, kWatch, kJog, kMdi, kPut, kGet, kPipe, kExport, kImport, kSwap, kRecord, kSave, kApproach, kDocument } what = What::kService;
  double seconds = 0;           ///< kJog: how long; kWatch: how long, 0 = until a signal
  double rate = 5;              ///< kWatch: lines per second
  bool all = false;             ///< the history: all of it
  bool start = false;           ///< kMdi: the blocks are started as well
  std::string file;             ///< kPut, kGet, kExport, kImport, kSwap, kRecord, kSave: file on this side, "-" = standard input or output
  std::string document;         ///< kDocument: markdown, man or bash
};

/** Reads the command line. @return -1 when *command says what to do, else the exit status: what is wrong was said, with --json among the words as an object. */
int parse_control_command(int argc, const char* const* argv, ControlCommand* command);

/** Whether errors are to be said as JSON, also where the command line cannot be read. */
bool asks_for_json(int argc, const char* const* argv);

/** Says why a command has not been done: an object on `out`, or lines on `err`, as which it is said also where `out` cannot be written. @return the exit status. */
int report_refusal(const ServiceRefusal& refusal, bool json, std::FILE* out, std::FILE* err);

/**
 * A standard stream that is closed would be the next socket or file that is opened, and what is printed would go there. From here on it can be used for nothing instead: a read
 * or a write of it fails.
 */
void keep_standard_descriptors();

/** @return the exit status of ncctl. @param open_remote null where there is no DDS. */
int control_command(const ControlCommand& command, OpenRemote open_remote, std::FILE* in, std::FILE* out, std::FILE* err);

}  // namespace nc::tools
