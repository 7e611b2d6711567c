// SPDX-License-Identifier: Apache-2.0
// The types of the services over DDS, in IDL and in Python. See control_words.hpp.
#include <string>

#include "runtime/services/service_table.hpp"
#include "tools/lib/control_words.hpp"

namespace nc::tools {
namespace {

using rt::services::Right;
using rt::services::ServiceRow;
using rt::services::kRightCount;

struct Member {
  const char* name;
  const char* kind;
  std::size_t most;  // bytes of a text
  const char* meaning;
  bool key;
};
struct ServiceType {
  const char* name;
  const char* kind;  // struct, or enum: its members are the enumerators
  std::initializer_list<Member> members;
};
const ServiceType kTypes[] = {
    {"ServiceStatus", "enum", {{"SERVICE_DONE", "", 0, "", false}, {"SERVICE_REFUSED", "", 0, "", false}, {"SERVICE_UPDATE", "", 0, "", false}}},
    {"ServiceRequest", "struct",
     {{"client", "text", rt::services::kMostRemoteClient, "unique for each running client: letters, digits, '.', '-', '_', '@'", true},
      {"number", "unsigned long long", 0, "of the client's choice, from 1; replies have it, too. No other open request of the client has it", false},
      {"service", "text", rt::services::kMostServiceName, "", false},
      {"args", "text", rt::services::kMostArguments, "its arguments as a JSON object; \"\" = none", false}}},
    {"ServiceReply", "struct",
     {{"client", "text", rt::services::kMostRemoteClient, "", true},
      {"number", "unsigned long long", 0, "of the request; 0 = an update of a watch list", false},
      {"status", "ServiceStatus", 0, "", false},
      {"refusal", "text", rt::services::kMostServiceName, "name of the refusal, such as busy; \"\" = none", false},
      {"session", "unsigned long long", 0, "another one than before: what the client had begun (control, jogs, watch lists, uploads) has ended", false},
      {"part", "unsigned long", 0, "from 1; a long reply has several parts, in their order", false},
      {"last", "boolean", 0, "this part is the last one", false},
      {"body", "text", rt::services::kPartBytes, "JSON, when all parts are put together: the reply, the update, or the text of the refusal", false}}}};

std::string services_of(Right right) {
  std::string text;
  for (const ServiceRow& row : rt::services::service_table())
    if (row.right == right) text += (text.empty() ? "" : ", ") + std::string(row.name);
  return text;
}

// Breaks a list into lines of a comment.
std::string comment(const std::string& text, const std::string& begin) {
  constexpr std::size_t kColumns = 130;
  std::string lines, line = begin;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = text.find(' ', at);
    if (end == std::string::npos) end = text.size();
    if (line.size() + 1 + end - at > kColumns) {
      lines += line + "\n";
      line = begin;
    }
    line += " " + text.substr(at, end - at);
    at = end + 1;
  }
  return lines + line + "\n";
}

std::string idl_type(const Member& member) { return std::string(member.kind) == "text" ? "string<" + std::to_string(member.most) + ">" : member.kind; }

std::string python_type(const Member& member) {
  const std::string kind = member.kind;
  if (kind == "text") return "types.bounded_str[" + std::to_string(member.most) + "]";
  return kind == "unsigned long long" ? "types.uint64" : kind == "unsigned long" ? "types.uint32" : kind == "boolean" ? "bool" : kind;
}

std::string idl_of(const ServiceType& type) {
  std::string text = "\n  @appendable\n  " + std::string(type.kind) + " " + type.name + " {";
  if (std::string(type.kind) == "enum") {
    for (const Member& member : type.members) text += (&member == type.members.begin() ? " " : ", ") + std::string(member.name);
    return text + " };\n";
  }
  text += "\n";
  for (const Member& member : type.members) {
    std::string line = "    " + std::string(member.key ? "@key " : "") + idl_type(member) + " " + member.name + ";";
    if (member.meaning[0] != '\0') line += std::string(line.size() < 37 ? 37 - line.size() : 1, ' ') + "// " + member.meaning;
    text += line + "\n";
  }
  return text + "  };\n";
}

std::string python_of(const ServiceType& type) {
  const bool is_enum = std::string(type.kind) == "enum";
  const std::string name = type.name;
  std::string text = is_enum ? "@annotate.appendable\nclass " + name + "(IdlEnum, typename=\"nc." + name + "\", default=\"" + type.members.begin()->name + "\"):\n"
                             : "@dataclass\n@annotate.appendable\nclass " + name + "(IdlStruct, typename=\"nc." + name + "\"):\n";
  unsigned value = 0;
  for (const Member& member : type.members) {
    text += "    " + std::string(member.name) + (is_enum ? " = " + std::to_string(value++) : ": " + python_type(member)) + "\n";
    if (member.key) text += "    annotate.key(\"" + std::string(member.name) + "\")\n";
  }
  return text + "\n\n";
}

}  // namespace

std::string services_idl() {
  std::string text;
  for (unsigned right = 0; right < kRightCount; ++right) {
    const auto which = static_cast<Right>(right);
    text += comment("topic " + std::string(rt::services::topic_of(which)) + ", requests that need the right to " + right_name(which) + ": " + services_of(which), "  //");
  }
  text += comment("A request to " + std::string(rt::services::topic_of(Right::kOperate)) + ", " + rt::services::topic_of(Right::kSetUp) + " or " + rt::services::topic_of(Right::kMaintain) +
                      " may also use the services of view. Topic nc_ServiceReply, in the partition MACHINE/CLIENT: replies and updates.",
                  "  //");
  for (const ServiceType& type : kTypes) text += idl_of(type);
  return text;
}

std::string services_python() {
  std::string text;
  for (const ServiceType& type : kTypes) text += python_of(type);
  text += "# The topic of the requests for each service, by the right that it needs.\nSERVICE_TOPICS = {\n";
  for (const ServiceRow& row : rt::services::service_table()) text += "    \"" + std::string(row.name) + "\": \"" + rt::services::topic_of(row.right) + "\",\n";
  return text + "}\nCHUNK_BYTES = " + std::to_string(rt::services::kChunkBytes) + "  # of a program, in one request or reply, at most\n";
}

}  // namespace nc::tools
