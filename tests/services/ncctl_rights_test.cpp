// SPDX-License-Identifier: Apache-2.0
// What ncctl says to who lacks a right: each of its commands with each set of rights, in the words of the row of its service.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "services/local_machine.hpp"
#include "services/service_arguments.hpp"
#include "tools/lib/control_command.hpp"
#include "tools/lib/control_words.hpp"

namespace nc::test {
namespace {

using rt::services::kRightCount;
using rt::services::Right;
using rt::services::RightSet;
using rt::services::Service;
using rt::services::ServiceRow;

std::string contents(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  std::fclose(file);
  return text;
}

// A command of ncctl, and the service whose right it needs.
struct Line {
  std::vector<std::string> words;
  const ServiceRow* row;
};

void add_value(const Json& value, std::vector<std::string>* words) {
  if (value.is_array())
    for (const Json& element : value) words->push_back(element.get<std::string>());
  else
    words->push_back(value.is_string() ? value.get<std::string>() : value.is_boolean() ? "on" : value.dump());
}

// The command that is this service: the members that it must have as arguments, one of the others as an option.
Line command_of(const ServiceRow& row) {
  Line line{{}, &row};
  const std::string name = row.name;
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('.', at), name.size());
    line.words.push_back(name.substr(at, end - at));
    at = end + 1;
  }
  Json args = arguments_of(row);
  for (const rt::services::Wanted& wanted : row.request) {
    const rt::services::FieldInfo& field = rt::services::row_of(wanted.field);
    if (!wanted.required && args.contains(field.name)) line.words.push_back(tools::option_name(field));
    if (args.contains(field.name)) add_value(args[field.name], &line.words);
  }
  if (row.service == Service::kJog) line.words.insert(line.words.end(), {"--for", "0.01"});
  return line;
}

class ControlRights : public LocalMachine {
 protected:
  // The commands that change something; those that need the right to view are let by every right.
  std::vector<Line> lines() {
    std::vector<Line> all;
    for (const ServiceRow& row : rt::services::service_table())
      if (tools::is_command(row) && row.right != Right::kView) all.push_back(command_of(row));
    write_program("file.nc", "M30\n");
    const auto add = [&](std::vector<std::string> words, Service service) { all.push_back({std::move(words), &rt::services::row_of(service)}); };
    add({"programs", "put", in_programs("file.nc")}, Service::kProgramBegin);
    add({"tables", "import", in_programs("file.nc")}, Service::kImport);
    add({"parameters", "import", in_programs("file.nc")}, Service::kParameterImport);
    add({"ladder", "swap", in_programs("file.nc")}, Service::kLadderSwap);
    add({"trace", "record", "nc.feed"}, Service::kTraceArm);
    add({"mdi", "--start", "M0"}, Service::kMdi);
    return all;
  }
  // The exit status; what it says is in said_to_user_.
  int ncctl(const std::vector<std::string>& words) {
    std::vector<const char*> argv{"ncctl", "--socket", path_.c_str()};
    for (const std::string& word : words) argv.push_back(word.c_str());
    tools::ControlCommand command;
    const int wrong = tools::parse_control_command(static_cast<int>(argv.size()), argv.data(), &command);
    EXPECT_EQ(wrong, -1) << "the command line cannot be read";
    std::FILE *in = std::fopen("/dev/null", "re"), *out = std::tmpfile(), *err = std::tmpfile();
    const int status = tools::control_command(command, nullptr, in, out, err);
    std::fclose(in);
    std::fclose(out);
    said_to_user_ = contents(err);
    return status;
  }
  std::string said_to_user_;
};

TEST_F(ControlRights, EachCommandNamesTheRightThatItsServiceNeeds) {
  unsigned refused = 0;
  for (unsigned bits = 1; bits < 1u << kRightCount; ++bits) {
    RightSet rights;
    for (unsigned right = 0; right < kRightCount; ++right)
      if ((bits >> right & 1u) != 0) rights.add(static_cast<Right>(right));
    {
      const std::lock_guard lock(mutex_);
      rights_ = rights;
    }
    for (const Line& line : lines()) {
      if (line.row->allows(rights)) continue;
      SCOPED_TRACE(testing::Message() << line.words[0] << " " << (line.words.size() > 1 ? line.words[1] : "") << " with the rights " << bits);
      EXPECT_EQ(ncctl(line.words), tools::kControlNoRight);
      EXPECT_EQ(said_to_user_, "ncctl: " + std::string(line.row->name) + " needs the right to " + rights_text(*line.row) + "\n");
      ++refused;
    }
  }
  EXPECT_GT(refused, 250u);
}

// The history has the service that was asked for, too.
TEST_F(ControlRights, TheHistoryNamesWhatWasAskedFor) {
  give({Right::kView});
  EXPECT_EQ(ncctl({"jog", "X", "1", "--for", "0.01"}), tools::kControlNoRight);
  ServiceClient viewer(path_);
  const Json entries = until(&viewer, "history.list", [](const Json& now) { return !now["entries"].empty(); }, {{"kind", "action"}})["entries"];
  ASSERT_EQ(entries.size(), 1u) << entries;
  EXPECT_EQ(entries[0]["service"], "jog");
  EXPECT_EQ(entries[0]["outcome"], "refused: no right");
}

}  // namespace
}  // namespace nc::test
