// SPDX-License-Identifier: Apache-2.0
// The one table of services: the name of each, the right that it needs, what a request holds, what a reply holds, and what it means. The decoder of requests,
// ncctl with its manual page and its completion, and docs/services.md come from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/services/rights.hpp"
#include "runtime/share/layout.hpp"
#include "runtime/share/request_table.hpp"

namespace nc::rt::services {

// A field of requests. It has the same meaning and the same limits in each of them.
enum class Field : std::uint8_t {
  kSystem, kLease, kLifespan, kMode, kPercent, kOn, kAxis, kVelocity, kBlocks, kFile, kDevice, kDeviceValue, kFrom, kCount, kTool, kLength, kLengthWear,
  kRadius, kRadiusWear, kOffset, kValue, kVariable, kVariableValue, kVacant, kParameter, kText, kNewName, kBegin, kBytes, kSize, kHash, kReplace, kUpload, kData, kSince, kUntil, kEntryKind, kUser,
  kTable, kToml, kChange, kSignals, kTrigger, kWhen, kLevel, kSamples, kBefore, kRecording, kDevices, kLadderText, kLadderName, kInterval, kWatch,
  kBlock, kSequence, kLine, kPassing, kInFile, kPowerOff, kLastStop, kEntry, kSpeed, kCheckSeconds, kVariableName, kAll,
  kLifeRow, kLifeGroup, kLifeTool, kLifeFlags, kLifeStatus, kLife, kLifeUsed, kLifeLength, kLifeRadius, kLifeAuxiliary, kParameterToml, kOf, kToolName, kPocket, kKeptRights, kBehalf, kFields
};
inline constexpr unsigned kFields = static_cast<unsigned>(Field::kFields);

enum class Kind : std::uint8_t { kNumber, kWhole, kFlag, kText, kName, kData, kList };
const char* kind_name(Kind kind);

struct FieldInfo {
  Field field;
  const char* name;
  Kind kind;
  double least, most;  // numbers: the range; texts: the number of bytes; data: the number of bytes before their encoding; lists: the number of texts
  const char* unit;
  const char* meaning;
};

struct Wanted {
  Field field;
  bool required;
};

// A member of a reply. "tools[].number" is the member `number` of each element of the array `tools`.
struct ReplyRow {
  const char* path;
  const char* type;
  const char* meaning;
};

enum class Service : std::uint8_t {
  kRights, kLimit, kServices, kMachine, kStatus, kAlarms, kHistory, kCounters, kProgramTimes, kChanges, kTools, kLives, kOffsets, kVariables, kParameters, kParameterExport, kExport, kPrograms, kProgramRead, kProgramCheck,
  kTraceSignals, kTraceStatus, kTraceRead, kLadderRungs, kLadderDevices, kWatchBegin, kWatchEnd, kRestartStatus,
  kTakeControl, kReleaseControl, kStart, kHold, kReset, kSetMode, kFeedOverride, kRapidOverride, kSingleBlock, kOptionalStop, kJog, kMdi, kSelect, kProgramRecheck, kRestartFind, kRestartConfirm, kRestartApproach, kRestartCancel,
  kSetTool, kSetLife, kSetOffset, kSetVariable, kImport, kUndo, kProgramBegin, kProgramData, kProgramFinish, kProgramAbandon, kProgramRename, kProgramDelete,
  kForce, kRelease, kWriteDevice, kSetParameter, kParameterImport, kUndoParameter, kProgramProtect, kTraceArm, kTraceStop, kLadderSwap, kServiceCount
};
inline constexpr unsigned kServiceRows = static_cast<unsigned>(Service::kServiceCount);

// Where a service is executed: kNow in the thread of the sockets, because it only copies what is there; the other ones in a thread each, so that a command does
// not wait for the data of a program.
enum class Lane : std::uint8_t { kNow, kCommand, kData };

struct ServiceRow {
  Service service;
  const char* name;  // with a point between two words: "programs.list"
  Right right;
  Lane lane;
  share::RequestKind command;  // of the intake, for Lane::kCommand
  std::span<const Wanted> request;
  std::span<const ReplyRow> reply;
  const char* meaning;
  std::optional<Right> and_right = {};  // is needed besides `right`: what the ladder is told to do can move the machine

  bool allows(RightSet rights) const { return rights.has(right) && (!and_right || rights.has(*and_right)); }
  // What is said of the command that it gives; nothing of a service that gives none.
  const share::RequestRow& of_command() const { return share::request_row(command); }
};
// The rights that are needed, in words: "maintain and operate".
std::string rights_text(const ServiceRow& row);

// The topic on which a request may use the services of this right, and those of view.
const char* topic_of(Right right);

std::span<const ServiceRow> service_table();
const ServiceRow* find_service(std::string_view name);
// The service that gives this command.
const ServiceRow* find_service(share::RequestKind command);
const ServiceRow& row_of(Service service);
const FieldInfo& row_of(Field field);

// Bounds of the protocol.
inline constexpr std::size_t kChunkBytes = 256 * 1024;            // of a program, in one request or reply
inline constexpr std::size_t kMostFrameBytes = 512 * 1024;        // of one request or reply, without its length
inline constexpr std::size_t kMostToml = 384 * 1024;             // bytes of tables in one request: with the signs that JSON adds they have room in a frame
inline constexpr std::size_t kMostLadder = 384 * 1024;            // bytes of a ladder program in one request
inline constexpr unsigned kMostWatched = 64;                       // devices of one watch list
inline constexpr unsigned kShortestInterval = 20, kLongestInterval = 60000;  // ms, between two updates of a watch list
inline constexpr std::size_t kLongestText = 64;                    // bytes of one text of a list
inline constexpr unsigned kWholePage = 500;                        // elements of a list in one reply, unless `count` asks for fewer
inline constexpr std::uint32_t kProtocol = 1;
// Of the services over DDS (dds/nc_dds.idl).
inline constexpr unsigned kMostRemoteClient = 27;                   // bytes of the name of a client
inline constexpr unsigned kMostServiceName = 31;
inline constexpr std::size_t kMostArguments = kMostFrameBytes - 256;  // bytes of the arguments of a request, in JSON
inline constexpr std::size_t kPartBytes = 60000;                    // of a reply; a longer one comes in several parts
inline constexpr unsigned kMostBehalf = 31;                        // bytes of the name of another for whom a connection asks

}  // namespace nc::rt::services
