// SPDX-License-Identifier: Apache-2.0
// The table of services. See service_table.hpp.
#include "runtime/services/service_table.hpp"

#include <array>

#include "runtime/share/intake.hpp"
#include "runtime/tools/tool_labels.hpp"
#include "runtime/trace/recording.hpp"

namespace nc::rt::services {
namespace {

using share::Intake;
using share::RequestKind;

constexpr double kMost32 = 2147483647.0;
constexpr double kMostPercent = 10.0 * 100;  // nc_config::max_feed_override
constexpr double kMostOffset = 1e6;  // mm, as in the configuration
constexpr double kMostTime = 9e9;      // s; in ns it fits into 63 bits
constexpr double kMostSize = 9007199254740992.0;  // bytes; whole numbers up to here are exact

// In the order of Field.
constexpr FieldInfo kFieldTable[] = {
    {Field::kSystem, "system", Kind::kWhole, 0, NC_MAX_SYSTEMS, "", "part system, from 1; 0 = all of them, where that is possible"},
    {Field::kLease, "lease_ms", Kind::kWhole, Intake::kMinLeaseMs, Intake::kMaxLeaseMs, "ms", "control ends when nothing has come from the client for this time; 2000 when it is not given"},
    {Field::kLifespan, "lifespan_ms", Kind::kWhole, 1, Intake::kMaxLifespanMs, "ms", "a command that is older than this when its turn comes is not executed; 2000 when it is not given"},
    {Field::kMode, "mode", Kind::kText, 1, 8, "", "auto, mdi or manual"},
    {Field::kPercent, "percent", Kind::kNumber, 0, kMostPercent, "%", "override; the machine's configuration has the largest one"},
    {Field::kOn, "on", Kind::kFlag, 0, 1, "", "on or off"},
    {Field::kAxis, "axis", Kind::kText, 1, 1, "", "name of an axis of the part system"},
    {Field::kVelocity, "velocity", Kind::kNumber, -1e6, 1e6, "mm/s, deg/s", "velocity with its sign; 0 stops. To be repeated within 200 scans, else the axis stops"},
    {Field::kBlocks, "blocks", Kind::kText, 1, share::kMdiText - 2, "", "blocks of a program, separated by line ends"},
    {Field::kFile, "name", Kind::kName, 1, 127, "", "name of a program in the folder of programs"},
    {Field::kDevice, "device", Kind::kText, 1, 64, "", "device of the ladder, or a signal's name"},
    {Field::kDeviceValue, "value", Kind::kWhole, -2147483648.0, 4294967295.0, "", "value of the device"},
    {Field::kFrom, "from", Kind::kWhole, 0, kMost32, "", "the list begins with this number, or behind so many entries; 0 when it is not given"},
    {Field::kCount, "count", Kind::kWhole, 1, kWholePage, "", "entries of the list at most; 500 when it is not given"},
    {Field::kTool, "number", Kind::kWhole, 1, 999, "", "number of a tool offset set"},
    {Field::kLength, "length", Kind::kNumber, -kMostOffset, kMostOffset, "mm", "tool length"},
    {Field::kLengthWear, "length_wear", Kind::kNumber, -kMostOffset, kMostOffset, "mm", "wear of the length"},
    {Field::kRadius, "radius", Kind::kNumber, -kMostOffset, kMostOffset, "mm", "tool radius"},
    {Field::kRadiusWear, "radius_wear", Kind::kNumber, -kMostOffset, kMostOffset, "mm", "wear of the radius"},
    {Field::kOffset, "index", Kind::kWhole, 0, 400, "", "set of work offsets: 0 the external one, 1 to 6 the six of every control, 100 + n the nth of the further ones"},
    {Field::kValue, "value", Kind::kNumber, -kMostOffset, kMostOffset, "mm, deg", "value of the offset"},
    {Field::kVariable, "number", Kind::kWhole, 1, kMost32, "", "number of a common variable"},
    {Field::kVariableValue, "value", Kind::kNumber, -1e15, 1e15, "", "value of the variable"},
    {Field::kVacant, "vacant", Kind::kFlag, 0, 1, "", "true: the variable becomes vacant, and there is no value"},
    {Field::kParameter, "key", Kind::kText, 1, 23, "", "number or name of a parameter in the manual"},
    {Field::kText, "value", Kind::kText, 1, 63, "", "value in the manual's units: a number, or a word of the manual"},
    {Field::kNewName, "new_name", Kind::kName, 1, 127, "", "new name, in the same folder"},
    {Field::kBegin, "begin", Kind::kWhole, 0, kMostSize, "bytes", "place of the first byte, from 0"},
    {Field::kBytes, "bytes", Kind::kWhole, 1, kChunkBytes, "bytes", "number of bytes at most"},
    {Field::kSize, "size", Kind::kWhole, 0, kMostSize, "bytes", "bytes of the whole program"},
    {Field::kHash, "sha256", Kind::kText, 64, 64, "", "SHA-256 of the whole program, 64 hexadecimal digits in any case"},
    {Field::kReplace, "replace", Kind::kFlag, 0, 1, "", "true: a program of this name is replaced; otherwise it is refused"},
    {Field::kUpload, "upload", Kind::kWhole, 1, kMost32, "", "number that programs.begin gave"},
    {Field::kData, "data", Kind::kData, 1, kChunkBytes, "bytes", "bytes in base64"},
    {Field::kSince, "since", Kind::kNumber, 0, kMostTime, "s", "only what came at this time or later: seconds since 1970"},
    {Field::kUntil, "until", Kind::kNumber, 0, kMostTime, "s", "only what came at this time or earlier: seconds since 1970"},
    {Field::kEntryKind, "kind", Kind::kText, 1, 8, "", "only entries of this kind: alarm, message, action, change, run or system"},
    {Field::kUser, "user", Kind::kText, 1, 64, "", "only what this user has done"},
    {Field::kTable, "table", Kind::kText, 4, 9, "", "tools, life, offsets or variables; all of them when it is not given"},
    {Field::kToml, "toml", Kind::kText, 1, kMostToml, "", "the sections [tool_offsets], [work_offsets], [tool_life], [variables], [variable_names], or some of them, as tables.export gives them"},
    {Field::kChange, "change", Kind::kWhole, 1, kMostSize, "", "number of the change; the last one of this user when it is not given"},
    {Field::kSignals, "signals", Kind::kList, 1, trace::kMostSignals, "", "names of signals, of points, and of devices of the ladder"},
    {Field::kTrigger, "trigger", Kind::kText, 1, kLongestText, "", "the one of the signals at which the recording begins; it begins at once when it is not given"},
    {Field::kWhen, "when", Kind::kText, 3, 6, "", "rise: the trigger comes up to the level; fall: it goes below it; high: it is not below it; low: it is below it; change: it is another value than in the scan before; rise when it is not given"},
    {Field::kLevel, "level", Kind::kWhole, -2147483648.0, 2147483647.0, "", "level of the trigger; 1 when it is not given"},
    {Field::kSamples, "samples", Kind::kWhole, 1, trace::kMostRows, "", "scans that are recorded, at most as many as have room in 16 MiB: 63550 of 64 signals; 1000 when it is not given"},
    {Field::kBefore, "before", Kind::kWhole, 0, trace::kMostRows - 1.0, "", "how many of them are to be from before the trigger, fewer than samples; 0 when it is not given"},
    {Field::kRecording, "recording", Kind::kWhole, 1, kMost32, "", "number of the recording"},
    {Field::kDevices, "devices", Kind::kList, 1, 64, "", "names of devices of the ladder, as in its program"},
    {Field::kLadderText, "program", Kind::kText, 1, kMostLadder, "", "text of a ladder program"},
    {Field::kLadderName, "name", Kind::kName, 1, 127, "", "name of the ladder program in messages; \"swapped\" when it is not given"},
    {Field::kInterval, "interval_ms", Kind::kWhole, kShortestInterval, kLongestInterval, "ms", "time between two updates; 200 when it is not given"},
    {Field::kWatch, "watch", Kind::kWhole, 1, kMost32, "", "number of a watch list of this connection"},
    {Field::kBlock, "block", Kind::kWhole, 0, kMostSize, "", "the program goes on behind so many blocks that were executed"},
    {Field::kSequence, "sequence", Kind::kWhole, 1, kMost32, "", "the program goes on with the block of this sequence number"},
    {Field::kLine, "line", Kind::kWhole, 1, kMost32, "", "the program goes on with the block on this line"},
    {Field::kPassing, "passing", Kind::kWhole, 1, kMost32, "", "of a sequence number or line: when the program comes there for so many times; the first when it is not given"},
    {Field::kInFile, "file", Kind::kName, 1, 127, "", "of a sequence number or line: name of the program in which it stands, such as one that is called; the selected one when it is not given"},
    {Field::kPowerOff, "power_off", Kind::kFlag, 0, 1, "", "true: where the program was when the power failed"},
    {Field::kLastStop, "last_stop", Kind::kFlag, 0, 1, "", "true: where a reset, an alarm or a power cut has stopped the program last"},
    {Field::kEntry, "entry", Kind::kWhole, 1, 100, "", "number of an entry of the recovery list; all of them when it is not given"},
    {Field::kSpeed, "velocity", Kind::kNumber, 0, 1e6, "mm/s, deg/s", "velocity; the speed of jogs (plc.jog_feed) when it is not given or 0. To be repeated within 200 scans, else the axis stops"},
    {Field::kCheckSeconds, "seconds", Kind::kWhole, 1, 86400, "s", "processor time that the check may take; that of the configuration when it is not given"},
    {Field::kVariableName, "name", Kind::kText, 0, 7, "", "name of the variable: capital letters and digits, a letter first; an empty one takes it away"},
    {Field::kAll, "all", Kind::kFlag, 0, 1, "", "true: also the parameters that are not set"},
    {Field::kLifeRow, "number", Kind::kWhole, 1, NC_TOOL_LIVES, "", "row of the table of tool life; the tools of a group are used in this order"},
    {Field::kLifeGroup, "group", Kind::kWhole, 0, 99999999, "", "its group of tools; 0 = no tool is registered in this row"},
    {Field::kLifeTool, "tool", Kind::kWhole, 0, 99999999, "", "number of the tool"},
    {Field::kLifeFlags, "flags", Kind::kWhole, 0, 255, "", "bits 4 and 5 say what is counted: 0 minutes of cutting, 16 mounts, 32 uses; the others are kept as they are"},
    {Field::kLifeStatus, "status", Kind::kWhole, 0, 4, "", "0 not used, 1 in use, 2 its life has ended, 3 and 4 not to be used"},
    {Field::kLife, "life", Kind::kWhole, 0, 9999, "min or times", "its life: 0 to 4000 minutes or 0 to 9999 times; 0 = without end"},
    {Field::kLifeUsed, "used", Kind::kNumber, 0, 9999, "min or times", "what of its life has been used, in the same range"},
    {Field::kLifeLength, "length_offset", Kind::kWhole, 0, 999, "", "number of its offset for the length"},
    {Field::kLifeRadius, "radius_offset", Kind::kWhole, 0, 999, "", "number of its offset for the radius"},
    {Field::kLifeAuxiliary, "auxiliary", Kind::kNumber, -1e9, 1e9, "", "for the machine's own use"},
    {Field::kParameterToml, "toml", Kind::kText, 1, kMostToml, "", "the section [parameters], of further part systems [parameters2] ..., as parameters.export gives them"},
    {Field::kOf, "of", Kind::kText, 4, 64, "", "only changes of this row or value of a table: `tool 3`, `tool 3 radius_wear`, `life 3`, `offset 1 102`, `offset 1 102 X`, `variable 1 501`, `name 501`, `parameter 1 X 2001`, `parameter 1 - 1078`; the number before that of offsets, variables and parameters is the part system, - all axes"},
    {Field::kToolName, "name", Kind::kText, 0, kLongestToolName, "", "name of the tool for people; an empty one takes it away"},
    {Field::kPocket, "pocket", Kind::kWhole, 0, kMostPocket, "", "its pocket in the magazine, in which no other tool is; 0 = in none"},
    {Field::kKeptRights, "rights", Kind::kList, 1, kRightCount, "", "the rights that the connection keeps: view, operate, set up, maintain"},
    {Field::kBehalf, "behalf", Kind::kText, 3, kMostBehalf, "", "for whom the connection asks from now on, such as dds:screen-1: printable ASCII with a colon, as no user of the computer is called"},
};
static_assert(std::size(kFieldTable) == kFields);

constexpr Wanted must(Field field) { return {field, true}; }
constexpr Wanted may(Field field) { return {field, false}; }

// ---- requests ----
constexpr Wanted kPage[] = {may(Field::kFrom), may(Field::kCount)};
constexpr Wanted kHistoryArguments[] = {may(Field::kSince), may(Field::kUntil), may(Field::kEntryKind), may(Field::kUser), may(Field::kFrom), may(Field::kCount)};
constexpr Wanted kChangesArguments[] = {may(Field::kOf), may(Field::kFrom), may(Field::kCount)};
constexpr Wanted kSystemPage[] = {may(Field::kSystem), may(Field::kFrom), may(Field::kCount)};
constexpr Wanted kParametersArguments[] = {may(Field::kSystem), may(Field::kAll), may(Field::kFrom), may(Field::kCount)};
constexpr Wanted kReadArguments[] = {must(Field::kFile), must(Field::kBegin), must(Field::kBytes)};
constexpr Wanted kLimitArguments[] = {must(Field::kKeptRights), may(Field::kBehalf)};
constexpr Wanted kLeaseOnly[] = {may(Field::kLease)};
constexpr Wanted kCommandOnly[] = {may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kLifespanOnly[] = {may(Field::kLifespan)};
constexpr Wanted kModeArguments[] = {must(Field::kMode), may(Field::kLifespan)};
constexpr Wanted kPercentArguments[] = {must(Field::kPercent), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kOnArguments[] = {must(Field::kOn), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kJogArguments[] = {must(Field::kAxis), must(Field::kVelocity), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kMdiArguments[] = {must(Field::kBlocks), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kFindArguments[] = {may(Field::kBlock), may(Field::kSequence), may(Field::kLine), may(Field::kPassing), may(Field::kInFile), may(Field::kPowerOff), may(Field::kLastStop), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kConfirmArguments[] = {may(Field::kEntry), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kApproachArguments[] = {must(Field::kAxis), may(Field::kSpeed), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kSystemOnly[] = {may(Field::kSystem)};
constexpr Wanted kSelectArguments[] = {must(Field::kFile), may(Field::kSystem), may(Field::kLifespan)};
constexpr Wanted kToolArguments[] = {must(Field::kTool), may(Field::kLength), may(Field::kLengthWear), may(Field::kRadius), may(Field::kRadiusWear), may(Field::kToolName), may(Field::kPocket)};
constexpr Wanted kLifeArguments[] = {must(Field::kLifeRow), may(Field::kLifeGroup), may(Field::kLifeTool), may(Field::kLifeFlags), may(Field::kLifeStatus), may(Field::kLife),
                                     may(Field::kLifeUsed), may(Field::kLifeLength), may(Field::kLifeRadius), may(Field::kLifeAuxiliary)};
constexpr Wanted kOffsetArguments[] = {must(Field::kOffset), must(Field::kAxis), must(Field::kValue), may(Field::kSystem)};
constexpr Wanted kVariableArguments[] = {must(Field::kVariable), may(Field::kVariableValue), may(Field::kVacant), may(Field::kVariableName), may(Field::kSystem)};
constexpr Wanted kBeginArguments[] = {must(Field::kFile), must(Field::kSize), must(Field::kHash), may(Field::kReplace)};
constexpr Wanted kDataArguments[] = {must(Field::kUpload), must(Field::kBegin), must(Field::kData)};
constexpr Wanted kUploadOnly[] = {must(Field::kUpload)};
constexpr Wanted kRenameArguments[] = {must(Field::kFile), must(Field::kNewName)};
constexpr Wanted kCheckArguments[] = {must(Field::kFile), may(Field::kSystem)};
constexpr Wanted kRecheckArguments[] = {must(Field::kFile), may(Field::kSystem), may(Field::kCheckSeconds)};
constexpr Wanted kFileOnly[] = {must(Field::kFile)};
constexpr Wanted kForceArguments[] = {must(Field::kDevice), must(Field::kDeviceValue), may(Field::kLifespan)};
constexpr Wanted kReleaseArguments[] = {may(Field::kDevice), may(Field::kLifespan)};
constexpr Wanted kParameterArguments[] = {must(Field::kParameter), must(Field::kText), may(Field::kAxis), may(Field::kSystem)};
constexpr Wanted kExportArguments[] = {may(Field::kTable)};
constexpr Wanted kImportArguments[] = {must(Field::kToml)};
constexpr Wanted kParameterImportArguments[] = {must(Field::kParameterToml)};
constexpr Wanted kUndoArguments[] = {may(Field::kChange)};
constexpr Wanted kTraceArguments[] = {must(Field::kSignals), may(Field::kTrigger), may(Field::kWhen), may(Field::kLevel), may(Field::kSamples), may(Field::kBefore)};
constexpr Wanted kTraceReadArguments[] = {must(Field::kRecording), may(Field::kFrom), may(Field::kCount)};
constexpr Wanted kDevicesOnly[] = {must(Field::kDevices)};
constexpr Wanted kSwapArguments[] = {must(Field::kLadderText), may(Field::kLadderName)};
constexpr Wanted kWatchArguments[] = {must(Field::kDevices), may(Field::kInterval)};
constexpr Wanted kWatchOnly[] = {must(Field::kWatch)};
constexpr Wanted kProtectArguments[] = {must(Field::kFile), must(Field::kOn)};

// ---- replies ----
constexpr ReplyRow kDoneReply[] = {{"text", "text", "what there is to say about it, often nothing: \"of all part systems\""}};
constexpr ReplyRow kRightsReply[] = {{"client", "text", "the name under which this connection may have control"},
                                     {"rights[]", "text", "view, operate, set up, maintain"},
                                     {"control", "text", "the client that has control, empty = nobody"}};
constexpr ReplyRow kLimitReply[] = {{"client", "text", "the name under which this connection may have control from now on"}, {"rights[]", "text", "what it still has"}};
constexpr ReplyRow kServicesReply[] = {{"services[].name", "text", "name of the service"},
                                       {"services[].right", "text", "the right that it needs"},
                                       {"services[].and_right", "text", "a right that it needs besides, empty = none"},
                                       {"services[].meaning", "text", "what it does"},
                                       {"services[].request[].name", "text", "member of `args`"},
                                       {"services[].request[].type", "text", "number, whole, flag, text, name, data or list"},
                                       {"services[].request[].required", "flag", "the member must be there"}};
constexpr ReplyRow kMachineReply[] = {{"machine", "text", "name of the machine in its configuration"},
                                      {"control", "text", "name of the control, as in DDS"},
                                      {"version", "text", "of libnc"},
                                      {"cycle_us", "whole", "period of the scan"},
                                      {"max_feed_override_percent", "number", "largest feed override"},
                                      {"systems[].axes[].name", "text", "name of the axis"},
                                      {"systems[].axes[].rotary", "flag", "in degrees, otherwise in mm"},
                                      {"systems[].axes[].max_velocity", "number", "mm/s or deg/s"},
                                      {"systems[].axes[].soft_limits[]", "number", "lower and upper limit in machine coordinates; no member = none"}};
constexpr ReplyRow kStatusReply[] = {{"scan", "whole", "number of the scan that is shown"},
                                     {"time_ns", "whole", "time of day at its start, ns since 1970"},
                                     {"mode", "text", "auto, mdi or manual"},
                                     {"resetting", "flag", "a reset is going on"},
                                     {"alarms", "whole", "number of active alarms; warnings do not count"},
                                     {"warnings", "whole", "number of active warnings"},
                                     {"control", "text", "the client that has control, empty = nobody"},
                                     {"forced[].device", "text", "device of the ladder that is held"},
                                     {"forced[].value", "whole", "value at which it is held"},
                                     {"systems[].system", "whole", "part system, from 1"},
                                     {"systems[].state", "text", "idle, running, hold, stopped, alarm or manual"},
                                     {"systems[].state_text", "text", "the same in words, with the reason when nothing moves"},
                                     {"systems[].program", "text", "main program, \"MDI\", empty = none"},
                                     {"systems[].ready", "flag", "a program is selected, at its head or running"},
                                     {"systems[].file", "text", "file of the block in execution"},
                                     {"systems[].line", "whole", "its line"},
                                     {"systems[].block", "text", "its text"},
                                     {"systems[].main_line", "whole", "line of the main program that is in execution or was finished last"},
                                     {"systems[].lines", "whole", "lines of the main program, 0 = not known"},
                                     {"systems[].percent", "whole", "part of the main program that is done"},
                                     {"systems[].runs", "whole", "number of programs that came to their end without an alarm"},
                                     {"systems[].run_s", "number", "time in execution since the start, s"},
                                     {"systems[].modal", "text", "codes in force after the last finished block"},
                                     {"systems[].m", "whole", "last M code"},
                                     {"systems[].t", "whole", "last T code"},
                                     {"systems[].s", "number", "commanded speed of the spindle, 1/min"},
                                     {"systems[].spindle", "number", "measured speed, 1/min; no member = nothing measures it"},
                                     {"systems[].feed", "number", "feed, mm/min"},
                                     {"systems[].feed_commanded", "number", "commanded feed, mm/min"},
                                     {"systems[].feed_override_percent", "number", "override in force"},
                                     {"systems[].rapid_override_percent", "number", "override in force"},
                                     {"systems[].single_block", "flag", "single block is on"},
                                     {"systems[].optional_stop", "flag", "optional stop is on"},
                                     {"systems[].message", "text", "last message of a program"},
                                     {"systems[].refusal", "text", "why something that was asked for at the panel did not happen, empty = nothing"},
                                     {"systems[].axes[].name", "text", "name of the axis"},
                                     {"systems[].axes[].machine", "number", "commanded position in machine coordinates, mm or deg"},
                                     {"systems[].axes[].actual", "number", "measured position in machine coordinates"},
                                     {"systems[].axes[].work", "number", "commanded position in workpiece coordinates"},
                                     {"systems[].axes[].to_go", "number", "distance to go"},
                                     {"systems[].axes[].velocity", "number", "mm/s or deg/s"}};
constexpr ReplyRow kAlarmsReply[] = {{"alarms[].sequence", "whole", "number of this occurrence, from 1"},
                                     {"alarms[].code", "text", "the manual's code"},
                                     {"alarms[].text", "text", "what is wrong"},
                                     {"alarms[].axis", "text", "axis, empty = none"},
                                     {"alarms[].system", "whole", "part system, from 1"},
                                     {"alarms[].line", "whole", "line of the block that was in execution, 0 = none"},
                                     {"alarms[].warning", "flag", "lets a program go on to its end"},
                                     {"alarms[].message", "flag", "a message and no alarm"},
                                     {"alarms[].raised_ns", "whole", "time of day, ns since 1970"},
                                     {"alarms[].cleared_ns", "whole", "time of day at its end, 0 = active"},
                                     {"left_out", "whole", "active alarms that are not in the list, which holds 16"}};
constexpr ReplyRow kHistoryReply[] = {{"entries[].number", "whole", "number of the entry, in the order in which they came; one that is missing was dropped"},
                                      {"entries[].time_ns", "whole", "time of day as it was set then, ns since 1970"},
                                      {"entries[].end_ns", "whole", "of alarms and runs: time of day at the end, 0 = not yet, -1 = ncrtd ended before it"},
                                      {"entries[].kind", "text", "alarm, message, action, change, run or system"},
                                      {"entries[].system", "whole", "part system, from 1; 0 = none"},
                                      {"entries[].code", "text", "of an alarm: the manual's code; of a system entry: begin, end, clock, lost or damaged"},
                                      {"entries[].text", "text", "what it is about"},
                                      {"entries[].axis", "text", "axis, empty = none"},
                                      {"entries[].warning", "flag", "an alarm that lets a program go on to its end"},
                                      {"entries[].program", "text", "program in execution, empty = none"},
                                      {"entries[].line", "whole", "line of the block that was in execution, 0 = none"},
                                      {"entries[].user", "text", "name of the user, or his number when it has no name; empty = nobody, or one that DDS does not name"},
                                      {"entries[].client", "text", "name of the client"},
                                      {"entries[].service", "text", "service that was used"},
                                      {"entries[].outcome", "text", "of an action: done, accepted or why it was refused; of a run: completed, alarm or interrupted"},
                                      {"entries[].seconds", "number", "of a run: time in execution"},
                                      {"missing", "whole", "entries that were dropped since ncrtd began"},
                                      {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kCountersReply[] = {{"counters[].name", "text", "on: time that the machine has been on; running: time in execution; spindle: time that a spindle turned whose speed is measured; runs: programs that came to "
                                                                  "their end without an alarm; alarms: alarms, without warnings"},
                                       {"counters[].system", "whole", "part system, from 1; 0 = the whole machine"},
                                       {"counters[].number", "whole", "number of the spindle, 0 = none"},
                                       {"counters[].value", "number", "its value"},
                                       {"counters[].unit", "text", "s, or empty for a number"}};
constexpr ReplyRow kProgramTimesReply[] = {{"programs[].name", "text", "name of the program"},
                                           {"programs[].runs", "whole", "runs that came to their end without an alarm"},
                                           {"programs[].last_s", "number", "time in execution of the last one"},
                                           {"programs[].shortest_s", "number", "of the shortest one"},
                                           {"programs[].longest_s", "number", "of the longest one"},
                                           {"programs[].total_s", "number", "of all of them together"},
                                           {"programs[].last_ns", "whole", "time of day at the end of the last one, ns since 1970"},
                                           {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kChangesReply[] = {{"changes[].number", "whole", "number of the change, counted up over all starts"},
                                      {"changes[].time_ns", "whole", "time of day, ns since 1970"},
                                      {"changes[].user", "text", "name of the user, or his number when it has no name"},
                                      {"changes[].client", "text", "name of the client"},
                                      {"changes[].service", "text", "service that was used"},
                                      {"changes[].what", "text", "what was changed"},
                                      {"changes[].before", "text", "its value before, empty = none"},
                                      {"changes[].after", "text", "its value after it, empty = none"},
                                      {"changes[].undone_by", "whole", "number of the change that has taken it back, 0 = none"},
                                      {"changes[].lost", "flag", "a power cut has taken it: at the start of ncrtd its values were those from before it"}};
constexpr ReplyRow kExportReply[] = {{"toml", "text", "the sections [tool_offsets], [work_offsets], [tool_life], [variables], [variable_names]; of further part systems [variables2] ..."}};
constexpr ReplyRow kParameterExportReply[] = {{"toml", "text", "the section [parameters], of further part systems [parameters2] ..."}};
constexpr ReplyRow kTraceSignalsReply[] = {{"signals[].name", "text", "name of the signal or of the point"},
                                           {"signals[].type", "text", "bit, 16 bit or 32 bit"},
                                           {"signals[].meaning", "text", "what it says"},
                                           {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kTraceStatusReply[] = {{"recording", "whole", "number of the newest recording since the start of ncrtd, 0 = there was none, and no other member but state"},
                                          {"state", "text", "none, waiting (for the trigger), recording, complete or stopped"},
                                          {"user", "text", "user who has begun it"},
                                          {"client", "text", "client that has begun it"},
                                          {"signals[]", "text", "what is recorded"},
                                          {"trigger", "text", "the signal that it waits for, empty = none"},
                                          {"when", "text", "what of it: rise, fall, change, high or low; empty = no trigger"},
                                          {"level", "whole", "level of the trigger"},
                                          {"samples", "whole", "scans that were asked for"},
                                          {"before", "whole", "how many of them before the trigger"},
                                          {"recorded", "whole", "scans that it has"},
                                          {"cycle_us", "whole", "period of the scan"},
                                          {"triggered", "flag", "the trigger has come; this member and the next two are there when the recording has ended"},
                                          {"trigger_row", "whole", "row of the trigger, from 0; of the first scan when there was none"},
                                          {"trigger_ns", "whole", "time of day at its scan, ns since 1970; 0 on virtual time"}};
constexpr ReplyRow kTraceReadReply[] = {{"rows[].scan", "whole", "number of the scan"},
                                        {"rows[].time_s", "number", "time at its start, counted from that of the trigger, s"},
                                        {"rows[].values[]", "whole", "the values, in the order of the signals"},
                                        {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kLadderRungsReply[] = {{"file", "text", "file of the program, or the name under which it was swapped in"},
                                          {"swaps", "whole", "programs that were swapped in since the start of ncrtd; 0 = it is that of the configuration"},
                                          {"flow_scan", "whole", "number of the scan whose power flow is shown, at most 0.2 s old"},
                                          {"scan", "whole", "number of the scan that has left the values"},
                                          {"lines[].line", "whole", "line of the program that holds an instruction or a label"},
                                          {"lines[].rung", "whole", "first line of its rung; rungs are never divided"},
                                          {"lines[].instruction", "text", "the instruction"},
                                          {"lines[].operands[].name", "text", "device, constant or label, as it is written"},
                                          {"lines[].operands[].value", "whole", "value of the device; no member = it is no device, or its place is known in the scan only"},
                                          {"lines[].operands[].forced", "flag", "the device is held at this value; no member = as with the value"},
                                          {"lines[].power", "flag", "result of logic behind the instruction, of an output in front of it; no member = it was not executed in this scan, or has none"},
                                          {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kLadderDevicesReply[] = {{"scan", "whole", "number of the scan that has left the values"},
                                            {"devices[].name", "text", "name as in the request"},
                                            {"devices[].type", "text", "bit, 16 bit or 32 bit"},
                                            {"devices[].value", "whole", "its value"},
                                            {"devices[].forced", "flag", "it is held at this value"},
                                            {"devices[].meaning", "text", "of signals and points"}};
constexpr ReplyRow kLadderSwapReply[] = {{"text", "text", "how long it stays"},
                                         {"swaps", "whole", "programs that were swapped in since the start of ncrtd"},
                                         {"warnings[]", "text", "what in the program is probably a mistake"},
                                         {"set_back[]", "text", "outputs and signals to the NC that no instruction writes any more: they have the value of the start again"}};
constexpr ReplyRow kWatchReply[] = {{"watch", "whole", "number of the watch list, in its updates"}, {"devices[].name", "text", "name as in the request"}, {"devices[].type", "text", "bit, 16 bit or 32 bit"}};
constexpr ReplyRow kTraceArmReply[] = {{"recording", "whole", "its number"}};
// Of the rows of all tables.
constexpr char kChangedBy[] = "who has changed it last: a user, \"program part.nc\", \"MDI blocks\", \"machine\", or \"program\" when it is not known which program has; empty = nobody that is remembered";
constexpr char kChangedNs[] = "time of day of that, ns since 1970; 0 = not known";
constexpr ReplyRow kToolsReply[] = {{"tools[].number", "whole", "number of the set"},
                                    {"tools[].length", "number", "mm"},
                                    {"tools[].length_wear", "number", "mm"},
                                    {"tools[].radius", "number", "mm"},
                                    {"tools[].radius_wear", "number", "mm"},
                                    {"tools[].pocket", "whole", "pocket of the magazine, 0 = in none"},
                                    {"tools[].name", "text", "its name, empty = none"},
                                    {"tools[].changed_by", "text", kChangedBy},
                                    {"tools[].changed_ns", "whole", kChangedNs},
                                    {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kLivesReply[] = {{"lives[].number", "whole", "row of the table; the tools of a group are used in this order"},
                                    {"lives[].group", "number", "group of tools, 0 = no tool is registered here"},
                                    {"lives[].tool", "number", "number of the tool"},
                                    {"lives[].flags", "number", "as in the table of the manual; bits 4 and 5 are `counts`"},
                                    {"lives[].counts", "text", "what is counted: minutes (of cutting), mounts or uses"},
                                    {"lives[].status", "number", "as in the table of the manual"},
                                    {"lives[].state", "text", "status in words: not used, in use, ended, or not to be used"},
                                    {"lives[].life", "number", "minutes or times, 0 = without end"},
                                    {"lives[].used", "number", "minutes or times"},
                                    {"lives[].length_offset", "number", "number of its offset for the length"},
                                    {"lives[].radius_offset", "number", "number of its offset for the radius"},
                                    {"lives[].auxiliary", "number", "for the machine's own use"},
                                    {"lives[].changed_by", "text", kChangedBy},
                                    {"lives[].changed_ns", "whole", kChangedNs},
                                    {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kOffsetsReply[] = {{"offsets[].system", "whole", "part system, from 1"},
                                      {"offsets[].index", "whole", "set of work offsets"},
                                      {"offsets[].axes[].name", "text", "name of the axis"},
                                      {"offsets[].axes[].value", "number", "mm or deg"},
                                      {"offsets[].changed_by", "text", kChangedBy},
                                      {"offsets[].changed_ns", "whole", kChangedNs},
                                      {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kVariablesReply[] = {{"variables[].number", "whole", "number of the variable; those that are vacant are not in the list"},
                                        {"variables[].value", "number", "its value"},
                                        {"variables[].name", "text", "its name, empty = none"},
                                        {"variables[].changed_by", "text", kChangedBy},
                                        {"variables[].changed_ns", "whole", kChangedNs},
                                        {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kParametersReply[] = {{"parameters[].key", "text", "number or name in the manual"},
                                         {"parameters[].system", "whole", "part system, from 1"},
                                         {"parameters[].axis", "text", "name of the axis, empty = all axes"},
                                         {"parameters[].value", "text", "in the manual's units, empty = not set"},
                                         {"parameters[].set", "flag", "it has been set"},
                                         {"parameters[].name", "text", "what it means; empty = nothing in the control asks for it"},
                                         {"parameters[].values", "text", "unit and range, or the possible values; the one that holds while it is not set comes first"},
                                         {"parameters[].by_axis", "flag", "may differ from axis to axis"},
                                         {"parameters[].section", "text", "section of the manual"},
                                         {"parameters[].changed_by", "text", kChangedBy},
                                         {"parameters[].changed_ns", "whole", kChangedNs},
                                         {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kProgramsReply[] = {{"programs[].name", "text", "name of the file"},
                                       {"programs[].size", "whole", "bytes"},
                                       {"programs[].modified_ns", "whole", "time of day of the last change, ns since 1970"},
                                       {"programs[].protected", "flag", "cannot be changed before its protection is taken away"},
                                       {"programs[].selected", "flag", "selected in a part system"},
                                       {"programs[].check", "text", "unchecked, checking, passed or refused: its check in part system 1"},
                                       {"bytes", "whole", "of all programs together"},
                                       {"most_bytes", "whole", "that all programs may have together"},
                                       {"most_bytes_of_one", "whole", "that one program may have"},
                                       {"next", "whole", "`from` of the next request, 0 = the list is complete"}};
constexpr ReplyRow kReadReply[] = {{"data", "data", "bytes in base64"},
                                   {"size", "whole", "bytes of the whole program"},
                                   {"modified_ns", "whole", "time of its last change; when it differs between two pieces, the program was changed meanwhile"}};
constexpr ReplyRow kRestartReply[] = {{"system", "whole", "part system, from 1"},
                                      {"phase", "text", "none; searching; found: the next cycle start comes to the place; stands: the program stands there, and cycle start goes on; lost: it was not found or was forgotten, and nothing starts before it is found or cancelled, or a select says that the program begins at its head; ended"},
                                      {"text", "text", "what is looked for, or why it has ended"},
                                      {"read", "whole", "blocks that have been read, in steps"},
                                      {"file", "text", "name of the program in which the place is"},
                                      {"line", "whole", "line of the block with which the program goes on, 0 = not known"},
                                      {"program", "whole", "O number of its program, 0 = none"},
                                      {"depth", "whole", "0 in the main program, one more in each program that is called"},
                                      {"blocks", "whole", "blocks that come before it"},
                                      {"modal", "text", "codes in force there"},
                                      {"asked[]", "text", "what the program has asked the machine on the way, and what was answered with the present state: with another answer it may come there otherwise"},
                                      {"axes[].name", "text", "name of the axis"},
                                      {"axes[].place", "number", "where the program goes on, in machine coordinates, mm or deg; in a feed hold where its path has stopped"},
                                      {"axes[].machine", "number", "where the axis is"},
                                      {"axes[].to_go", "number", "the difference"},
                                      {"axes[].away", "flag", "cycle start waits for it; or, in another block stop, it was moved by hand"},
                                      {"codes[].entry", "whole", "number of the entry, from 1"},
                                      {"codes[].code", "text", "what the program has given to the machine before the place"},
                                      {"codes[].state", "text", "open; done: the machine has it; confirmed: the operator has said that it is right as it is"},
                                      {"open", "whole", "entries that are open: as long as there is one, the cycle start that goes on is refused"},
                                      {"left_out", "whole", "M codes that have come so long before that they are not in the list"}};
constexpr ReplyRow kCheckReply[] = {{"state", "text", "unchecked, checking, passed or refused"},
                                    {"text", "text", "why, or what is to be said of it"},
                                    {"alarms[].code", "text", "code of the alarm, empty = an axis would go beyond its limit"},
                                    {"alarms[].text", "text", "what is wrong"},
                                    {"alarms[].program", "text", "file in which it is"},
                                    {"alarms[].line", "whole", "its line"},
                                    {"alarms[].behind", "flag", "found without the lines of the alarms before it, whose absence may be the reason"},
                                    {"asks_line", "whole", "line of the first block that asks the machine: an input, a skip signal, the clock, a device; 0 = none does"},
                                    {"asks_program", "text", "file of that line"},
                                    {"seconds", "number", "estimated time at 100 %, without what M, S and T take"},
                                    {"length", "number", "mm, way of all moves"},
                                    {"blocks", "whole", "blocks that were executed"},
                                    {"axes[].name", "text", "name of the axis"},
                                    {"axes[].least", "number", "mm or deg, smallest machine coordinate"},
                                    {"axes[].most", "number", "mm or deg, largest machine coordinate"},
                                    {"tools[]", "whole", "tools as they are called, each once"},
                                    {"time_ns", "whole", "time of day of the check, ns since 1970; 0 = there is no result"}};
constexpr ReplyRow kBeginReply[] = {{"upload", "whole", "number of the upload, for this connection"}, {"bytes", "whole", "of one piece at most"}};
constexpr ReplyRow kDataReply[] = {{"begin", "whole", "place of the next byte"}};

constexpr RequestKind kNo = RequestKind::kCount;

// In the order of Service.
constexpr ServiceRow kRows[] = {
    {Service::kRights, "rights", Right::kView, Lane::kNow, kNo, {}, kRightsReply, "who the client is, and what it may do"},
    {Service::kLimit, "rights.limit", Right::kView, Lane::kNow, kNo, kLimitArguments, kLimitReply,
     "the connection gives up its other rights for good; `view` stays. It has no request open then. `behalf` is for root and the user of ncrtd, for one connection at a time: changes, history and control have that name, and not the user's"},
    {Service::kServices, "services", Right::kView, Lane::kNow, kNo, {}, kServicesReply, "this table"},
    {Service::kMachine, "machine", Right::kView, Lane::kNow, kNo, {}, kMachineReply, "what does not change while ncrtd runs: axes, limits, period"},
    {Service::kStatus, "status", Right::kView, Lane::kNow, kNo, {}, kStatusReply, "one consistent picture of the machine, at most 10 ms old"},
    {Service::kAlarms, "alarms", Right::kView, Lane::kNow, kNo, {}, kAlarmsReply, "the active alarms and warnings"},
    {Service::kHistory, "history.list", Right::kView, Lane::kData, kNo, kHistoryArguments, kHistoryReply,
     "the memory of the machine, the newest first: alarms, messages, actions of operators, changes, runs of programs; `from`: the number of the newest entry that is wanted"},
    {Service::kCounters, "history.counters", Right::kView, Lane::kData, kNo, {}, kCountersReply, "hours of the machine and of its spindles, runs, alarms, over all starts"},
    {Service::kProgramTimes, "history.programs", Right::kView, Lane::kData, kNo, kPage, kProgramTimesReply, "how often each program ran to its end, and how long"},
    {Service::kChanges, "changes", Right::kView, Lane::kData, kNo, kChangesArguments, kChangesReply, "who has changed what through the services, the newest first; `of` one row, with a `count` of 1: who has changed it last"},
    {Service::kTools, "tools.list", Right::kView, Lane::kData, kNo, kPage, kToolsReply, "tool offsets as the executed blocks have left them, with the names of the tools and their pockets in the magazine"},
    {Service::kLives, "life.list", Right::kView, Lane::kData, kNo, kPage, kLivesReply, "the table of tool life as the executed blocks have left it"},
    {Service::kOffsets, "offsets.list", Right::kView, Lane::kData, kNo, kSystemPage, kOffsetsReply, "work offsets as the executed blocks have left them"},
    {Service::kVariables, "variables.list", Right::kView, Lane::kData, kNo, kSystemPage, kVariablesReply, "common variables as the executed blocks have left them"},
    {Service::kParameters, "parameters.list", Right::kView, Lane::kData, kNo, kParametersArguments, kParametersReply, "the parameters that are set, or all of them, with their meaning and range"},
    {Service::kParameterExport, "parameters.export", Right::kView, Lane::kData, kNo, {}, kParameterExportReply, "the parameters that are set as TOML"},
    {Service::kExport, "tables.export", Right::kView, Lane::kData, kNo, kExportArguments, kExportReply,
     "tool offsets, work offsets, tool life and common variables as TOML, as the executed blocks have left them; variables that are vacant and rows of tool life without a tool are left out"},
    {Service::kPrograms, "programs.list", Right::kView, Lane::kData, kNo, kPage, kProgramsReply, "the files in the folder of programs, in the order of their names"},
    {Service::kProgramRead, "programs.read", Right::kView, Lane::kData, kNo, kReadArguments, kReadReply, "a piece of a program"},
    {Service::kProgramCheck, "programs.check", Right::kView, Lane::kData, kNo, kCheckArguments, kCheckReply,
     "what the check of a program has found, with the offsets, parameters and common variables that the machine had then; part system 1 when none is given"},
    {Service::kTraceSignals, "trace.signals", Right::kView, Lane::kData, kNo, kPage, kTraceSignalsReply, "the signals and points that can be recorded; devices of the ladder are named as in its program"},
    {Service::kTraceStatus, "trace.status", Right::kView, Lane::kData, kNo, {}, kTraceStatusReply, "how far the recording of signals is"},
    {Service::kTraceRead, "trace.read", Right::kView, Lane::kData, kNo, kTraceReadArguments, kTraceReadReply, "a recording that has ended, one row for each scan"},
    {Service::kLadderRungs, "ladder.rungs", Right::kView, Lane::kData, kNo, kPage, kLadderRungsReply,
     "the ladder program in whole rungs, with the power flow of one scan and the values of the devices; `from`: a line of the first rung, `count`: lines, more only to complete a rung"},
    {Service::kLadderDevices, "ladder.devices", Right::kView, Lane::kData, kNo, kDevicesOnly, kLadderDevicesReply, "values of devices, all as one scan has left them"},
    {Service::kWatchBegin, "watch.begin", Right::kView, Lane::kData, kNo, kWatchArguments, kWatchReply,
     "the values of the devices come again and again without a request, all of one scan, until watch.end or the end of the connection; see Watch lists"},
    {Service::kWatchEnd, "watch.end", Right::kView, Lane::kData, kNo, kWatchOnly, kDoneReply, "ends a watch list of this connection; no update comes behind the reply"},
    {Service::kRestartStatus, "restart.status", Right::kView, Lane::kData, kNo, kSystemOnly, kRestartReply, "a program that is begun inside: the place, the recovery list, and how far the operator is"},

    {Service::kTakeControl, "control.take", Right::kOperate, Lane::kCommand, RequestKind::kTakeControl, kLeaseOnly, kDoneReply,
     "the client becomes the only one whose commands are executed, until its lease ends; renews the lease. Every later command renews it as well"},
    {Service::kReleaseControl, "control.release", Right::kOperate, Lane::kCommand, RequestKind::kReleaseControl, {}, kDoneReply, "gives control back; jogs of the client end"},
    {Service::kStart, "start", Right::kOperate, Lane::kCommand, RequestKind::kCycleStart, kCommandOnly, kDoneReply, "cycle start; the reply comes when the program runs"},
    {Service::kHold, "hold", Right::kOperate, Lane::kCommand, RequestKind::kFeedHold, kCommandOnly, kDoneReply, "feed hold; the reply comes when the axes stand. It needs no control. In manual mode what moves by hand comes to rest and needs a new press"},
    {Service::kReset, "reset", Right::kOperate, Lane::kCommand, RequestKind::kReset, kLifespanOnly, kDoneReply, "reset of all part systems; the reply comes when it is done"},
    {Service::kSetMode, "mode", Right::kOperate, Lane::kCommand, RequestKind::kSetMode, kModeArguments, kDoneReply, "mode of the control"},
    {Service::kFeedOverride, "override.feed", Right::kOperate, Lane::kCommand, RequestKind::kFeedOverride, kPercentArguments, kDoneReply, "feed override of the operator"},
    {Service::kRapidOverride, "override.rapid", Right::kOperate, Lane::kCommand, RequestKind::kRapidOverride, kPercentArguments, kDoneReply, "rapid override of the operator, at most 100"},
    {Service::kSingleBlock, "single", Right::kOperate, Lane::kCommand, RequestKind::kSingleBlock, kOnArguments, kDoneReply, "single block"},
    {Service::kOptionalStop, "optional", Right::kOperate, Lane::kCommand, RequestKind::kOptionalStop, kOnArguments, kDoneReply, "optional stop"},
    {Service::kJog, "jog", Right::kOperate, Lane::kCommand, RequestKind::kJog, kJogArguments, kDoneReply, "moves an axis by hand, in mode manual"},
    {Service::kMdi, "mdi", Right::kOperate, Lane::kCommand, RequestKind::kMdi, kMdiArguments, kDoneReply, "loads blocks, in mode mdi; a start executes them"},
    {Service::kSelect, "select", Right::kOperate, Lane::kCommand, RequestKind::kSelectProgram, kSelectArguments, kDoneReply, "selects a program, in mode auto; a name such as O1000 of which there is no file is the program of this number, found as for a call. The reply comes when it has been checked, or after 10 s"},
    {Service::kProgramRecheck, "programs.recheck", Right::kOperate, Lane::kData, kNo, kRecheckArguments, kDoneReply,
     "checks a program once more, before those that wait, with what the tables of the machine hold now; programs.check shows the result"},
    {Service::kRestartFind, "restart.find", Right::kOperate, Lane::kCommand, RequestKind::kRestartFind, kFindArguments, kDoneReply,
     "looks for a place in the selected program, in mode auto, so that the next cycle start begins there; exactly one of block, sequence, line, power_off and last_stop. The reply comes when the search has begun"},
    {Service::kRestartConfirm, "restart.confirm", Right::kOperate, Lane::kCommand, RequestKind::kRestartConfirm, kConfirmArguments, kDoneReply,
     "the operator says that an entry of the recovery list, or all of them, need not be given out"},
    {Service::kRestartApproach, "restart.approach", Right::kOperate, Lane::kCommand, RequestKind::kRestartApproach, kApproachArguments, kDoneReply,
     "an axis goes to where the program goes on, in any block stop and any feed hold in which it was moved by hand; in mode manual, one axis at a time"},
    {Service::kRestartCancel, "restart.cancel", Right::kOperate, Lane::kCommand, RequestKind::kRestartCancel, kCommandOnly, kDoneReply,
     "the place is no longer looked for, or forgotten: the next cycle start begins at the head of the program"},

    {Service::kSetTool, "tools.set", Right::kSetUp, Lane::kData, kNo, kToolArguments, kDoneReply, "sets the given columns of a tool: its offset set, its name, its pocket in the magazine. Name and pocket can be set while a program is in execution"},
    {Service::kSetLife, "life.set", Right::kSetUp, Lane::kData, kNo, kLifeArguments, kDoneReply, "sets the given columns of a row of the table of tool life"},
    {Service::kSetOffset, "offsets.set", Right::kSetUp, Lane::kData, kNo, kOffsetArguments, kDoneReply, "sets one work offset"},
    {Service::kSetVariable, "variables.set", Right::kSetUp, Lane::kData, kNo, kVariableArguments, kDoneReply, "sets a common variable or makes it vacant, and gives it a name"},
    {Service::kImport, "tables.import", Right::kSetUp, Lane::kData, kNo, kImportArguments, kDoneReply,
     "sets what the sections name and leaves everything else as it is. The whole text is checked before the first value is set, and it is one change"},
    {Service::kUndo, "undo", Right::kSetUp, Lane::kData, kNo, kUndoArguments, kDoneReply,
     "takes a change of tool offsets, tool life, work offsets or variables back: the last one of this user that was not taken back. Refused when a value was changed since"},
    {Service::kProgramBegin, "programs.begin", Right::kSetUp, Lane::kData, kNo, kBeginArguments, kBeginReply, "begins to write a program; nobody sees it before programs.finish. Four are written at a time: one that has been silent for a minute makes room for another"},
    {Service::kProgramData, "programs.data", Right::kSetUp, Lane::kData, kNo, kDataArguments, kDataReply, "the next piece; pieces come in their order"},
    {Service::kProgramFinish, "programs.finish", Right::kSetUp, Lane::kData, kNo, kUploadOnly, kDoneReply, "compares size and SHA-256, brings the program to the disk and puts it in its place"},
    {Service::kProgramAbandon, "programs.abandon", Right::kSetUp, Lane::kData, kNo, kUploadOnly, kDoneReply, "drops what was written; the end of the connection does that as well"},
    {Service::kProgramRename, "programs.rename", Right::kSetUp, Lane::kData, kNo, kRenameArguments, kDoneReply, "gives a program another name that is free"},
    {Service::kProgramDelete, "programs.delete", Right::kSetUp, Lane::kData, kNo, kFileOnly, kDoneReply, "deletes a program"},

    {Service::kForce, "force", Right::kMaintain, Lane::kCommand, RequestKind::kForce, kForceArguments, kDoneReply, "holds a device of the ladder at a value until it is released", Right::kOperate},
    {Service::kRelease, "release", Right::kMaintain, Lane::kCommand, RequestKind::kReleaseForce, kReleaseArguments, kDoneReply, "lets a device go; without one, all of them", Right::kOperate},
    {Service::kWriteDevice, "ladder.write", Right::kMaintain, Lane::kCommand, RequestKind::kWriteDevice, kForceArguments, kDoneReply,
     "gives a device of the ladder a value once, before the next run of its program; what the machine or the NC writes in each scan is refused", Right::kOperate},
    {Service::kSetParameter, "parameters.set", Right::kMaintain, Lane::kData, kNo, kParameterArguments, kDoneReply, "sets a parameter"},
    {Service::kParameterImport, "parameters.import", Right::kMaintain, Lane::kData, kNo, kParameterImportArguments, kDoneReply,
     "sets the parameters that the sections name and leaves the others as they are. Every value is tried on a control apart before the first one is set, and it is one change"},
    {Service::kUndoParameter, "parameters.undo", Right::kMaintain, Lane::kData, kNo, kUndoArguments, kDoneReply, "takes a change of a parameter back, as undo does with other tables"},
    {Service::kProgramProtect, "programs.protect", Right::kMaintain, Lane::kData, kNo, kProtectArguments, kDoneReply, "protects a program against every change, or takes its protection away"},
    {Service::kTraceArm, "trace.arm", Right::kMaintain, Lane::kData, kNo, kTraceArguments, kTraceArmReply,
     "records the values of signals in each scan, from the next one on, or from so many before a trigger on. The recording before it is forgotten; one that has not ended is busy"},
    {Service::kTraceStop, "trace.stop", Right::kMaintain, Lane::kData, kNo, {}, kDoneReply, "ends the recording; what it has can be read"},
    {Service::kLadderSwap, "ladder.swap", Right::kMaintain, Lane::kData, kNo, kSwapArguments, kLadderSwapReply,
     "a ladder program takes the place of the one in execution, between two scans, and goes on with the state of its devices; refused with lines and reasons when it cannot, and while another client has control. It stays until ncrtd ends: each start takes the file of the configuration", Right::kOperate},
};
static_assert(std::size(kRows) == kServiceRows);

constexpr bool in_order() {
  for (unsigned i = 0; i < kFields; ++i)
    if (static_cast<unsigned>(kFieldTable[i].field) != i) return false;
  for (unsigned i = 0; i < kServiceRows; ++i)
    if (static_cast<unsigned>(kRows[i].service) != i || (kRows[i].lane == Lane::kCommand) != (kRows[i].command != kNo)) return false;
  return true;
}
static_assert(in_order());

}  // namespace

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::kNumber: return "number";
    case Kind::kWhole: return "whole";
    case Kind::kFlag: return "flag";
    case Kind::kText: return "text";
    case Kind::kName: return "name";
    case Kind::kData: return "data";
    case Kind::kList: return "list";
  }
  return "?";
}

const char* topic_of(Right right) {
  switch (right) {
    case Right::kView: return "nc_ServiceView";
    case Right::kOperate: return "nc_ServiceOperate";
    case Right::kSetUp: return "nc_ServiceSetUp";
    case Right::kMaintain: return "nc_ServiceMaintain";
  }
  return "?";
}

std::string rights_text(const ServiceRow& row) { return std::string(right_name(row.right)) + (row.and_right ? std::string(" and ") + right_name(*row.and_right) : ""); }

std::span<const ServiceRow> service_table() { return kRows; }

const ServiceRow* find_service(std::string_view name) {
  for (const ServiceRow& row : kRows)
    if (name == row.name) return &row;
  return nullptr;
}

const ServiceRow* find_service(RequestKind command) {
  for (const ServiceRow& row : kRows)
    if (row.command == command && command != kNo) return &row;
  return nullptr;
}

const ServiceRow& row_of(Service service) { return kRows[static_cast<unsigned>(service)]; }
const FieldInfo& row_of(Field field) { return kFieldTable[static_cast<unsigned>(field)]; }

}  // namespace nc::rt::services
