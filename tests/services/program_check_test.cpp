// SPDX-License-Identifier: Apache-2.0
// The check of programs before they may run.
#include <chrono>
#include <filesystem>
#include <thread>

#include "runtime/services/sha256.hpp"
#include "services/local_machine.hpp"

namespace nc::test {
namespace {

using rt::services::Right;

class ProgramCheckServices : public LocalMachine {
 protected:
  std::string check_text() override { return policy_; }
  // Writes a program through the services.
  static std::string put(ServiceClient* client, const std::string& name, const std::string& text, bool replace = false) {
    rt::services::Sha256 sum;
    sum.add(text);
    const Json begun = client->call("programs.begin", {{"name", name}, {"size", text.size()}, {"sha256", sum.finish()}, {"replace", replace}});
    if (begun["ok"] != true) return begun.dump();
    const std::string sent = client->outcome("programs.data", {{"upload", begun["reply"]["upload"]}, {"begin", 0}, {"data", rt::services::to_base64(text)}});
    return sent.empty() ? client->outcome("programs.finish", {{"upload", begun["reply"]["upload"]}}) : sent;
  }
  Json checked(ServiceClient* client, const std::string& name) {
    return until(client, "programs.check", [](const Json& reply) { return reply["state"] == "passed" || reply["state"] == "refused" || !reply["text"].get<std::string>().empty(); }, {{"name", name}});
  }
  Json put_and_check(ServiceClient* client, const std::string& name, const std::string& text) {
    EXPECT_EQ(put(client, name, text, true), "");
    return checked(client, name);
  }
  static std::string start(ServiceClient* client, std::string* text = nullptr) {
    const Json reply = client->call("start");
    if (text != nullptr && reply["ok"] == false) *text = reply["text"].get<std::string>();
    return reply["ok"] == true ? "" : reply["error"].get<std::string>();
  }
  static void take_control(ServiceClient* client) {
    ASSERT_EQ(client->outcome("control.take", {{"lease_ms", 60000}}), "");
    ASSERT_EQ(client->outcome("mode", {{"mode", "auto"}}), "");
  }
  std::string policy_ = "check = \"required\"\n";
};
class ProgramCheckWarns : public ProgramCheckServices {
 protected:
  ProgramCheckWarns() { policy_ = "check = \"warn\"\n"; }
};
class ProgramCheckOff : public ProgramCheckServices {
 protected:
  ProgramCheckOff() { policy_ = "check = \"off\"\n"; }
};

const char* const kGood = "G90 G21 G94\nT3 M6\nG0 X10. Y-5.\nG1 X40. F600.\nG3 X40. Y5. I0. J5.\nT12 M6\nT3\nM30\n";

TEST_F(ProgramCheckServices, SaysWhatAProgramDoes) {
  ServiceClient client(path_);
  const Json report = put_and_check(&client, "good.nc", kGood);
  EXPECT_EQ(report["state"], "passed") << report;
  EXPECT_TRUE(report["alarms"].empty());
  EXPECT_EQ(report["tools"], (Json{3, 12}));
  EXPECT_EQ(report["axes"][0]["name"], "X");
  EXPECT_NEAR(report["axes"][0]["least"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(report["axes"][0]["most"].get<double>(), 45, 1e-6) << "the half circle goes beyond its ends";
  EXPECT_NEAR(report["axes"][1]["least"].get<double>(), -5, 1e-9);
  EXPECT_NEAR(report["axes"][1]["most"].get<double>(), 5, 1e-9);
  EXPECT_NEAR(report["length"].get<double>(), std::hypot(10, 5) + 30 + 5 * M_PI, 1e-6);
  EXPECT_GT(report["seconds"].get<double>(), (30 + 5 * M_PI) / 10);
  EXPECT_LT(report["seconds"].get<double>(), (30 + 5 * M_PI) / 10 + 5);
  EXPECT_GT(report["time_ns"].get<std::int64_t>(), 0);
  EXPECT_EQ(client.call("programs.list")["reply"]["programs"][0]["check"], "passed");
}

// Who mends a program wants to see more than its first alarm: it is read again without the lines that have given one.
TEST_F(ProgramCheckServices, LooksBehindTheFirstAlarm) {
  ServiceClient client(path_);
  const auto lines = [](const Json& report) {
    std::string text;
    for (const Json& alarm : report["alarms"]) text += std::to_string(alarm["line"].get<int>()) + (alarm["behind"] == true ? "b " : " ");
    return text;
  };
  const Json report = put_and_check(&client, "many.nc", "G0 X1.\nG7.7\nG1 X2. F100.\n(\xc3\x98) G8.88\r\nM98 P999\nG1 X3.\nM30\n");
  EXPECT_EQ(report["state"], "refused") << report;
  EXPECT_EQ(lines(report), "2 4b 5b ") << report;
  EXPECT_NE(report["text"].get<std::string>().find("many.nc line 2: "), std::string::npos) << report;
  EXPECT_LT(report["axes"][0]["most"].get<double>(), 1.5) << "what it does is told up to the first alarm";
  std::string much;
  for (unsigned n = 0; n < 40; ++n) much += "G7.7\n";
  const Json most = put_and_check(&client, "much.nc", much + "M30\n");
  EXPECT_EQ(most["alarms"].size(), 20u);
  EXPECT_EQ(most["alarms"][19]["line"], 20);
  // A line of a called program is not left out: what comes behind it is not looked for.
  ASSERT_EQ(put(&client, "O77", "G0 X1.\nG7.7\nM99\n"), "");
  EXPECT_EQ(lines(put_and_check(&client, "calls.nc", "G7.7\nM98 P77\nG8.88\nM30\n")), "1 2b ");
  // No end is looked for where there is none without the line.
  const Json endless = put_and_check(&client, "endless.nc", "#1=1\nN1 #1=#1+1\nIF [#1 LT 100] GOTO 1\nG7.7\nM30\n");
  EXPECT_EQ(lines(endless), "4 ") << endless;
  EXPECT_EQ(put_and_check(&client, "one.nc", "G7.7\nG0 X1.\nM30\n")["alarms"].size(), 1u);
}

// M700 13.3, #1121: the number decides, whatever stands behind it in the name of the file, and whether or not the control has read the program.
TEST_F(ProgramCheckServices, AParameterProtectsNumbersOfPrograms) {
  ServiceClient client(path_);
  const char* const names[] = {"O9003.nc", "9004", "o9005.NC"};
  for (const char* name : names) ASSERT_EQ(put(&client, name, "M99\n"), "");
  ASSERT_EQ(put(&client, "O8999.nc", "M99\n"), "");
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "1121"}, {"value", "1"}}), "");
  for (const char* name : names) {
    EXPECT_EQ(put(&client, name, "M30\n", true).find("\"protected\"") != std::string::npos, true) << name;
    EXPECT_EQ(client.outcome("programs.delete", {{"name", name}}), "protected") << name;
    EXPECT_EQ(client.outcome("programs.rename", {{"name", name}, {"new_name", "other.nc"}}), "protected") << name;
  }
  EXPECT_EQ(client.outcome("programs.rename", {{"name", "O8999.nc"}, {"new_name", "O9999.nc"}}), "protected");
  EXPECT_NE(put(&client, "O9003", "M30\n"), "") << "it would be called in place of O9003.nc";
  const Json listed = client.call("programs.list");
  for (const Json& program : listed["reply"]["programs"]) EXPECT_EQ(program["protected"], program["name"] != "O8999.nc") << program;
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "1121"}, {"value", "0"}}), "");
  EXPECT_EQ(client.outcome("programs.delete", {{"name", "O9003.nc"}}), "");
}

// What a call by the number would find is protected, and what it would not find is not: a name with several points is found by what stands in front of the first one, and in place of
// the program with the plain name where it is the first in order.
TEST_F(ProgramCheckServices, WhatACallByAProtectedNumberFindsIsProtected) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "1121"}, {"value", "1"}}), "");
  unsigned found = 0;
  for (const char* name : {"O9003.a.nc", "O9003.a.b", "O9003..nc", "O9003.!.nc", "o9003.b.c", "O09003.nc.bak", "O9003.tar.gz", "O9003.9.8.7", "O9003a.nc", "O9003~", "O9003 .nc", "part.O9003.nc", "O8999.9003.nc", "9003.0.nc"}) {
    SCOPED_TRACE(name);
    write_program(name, "M99\n");
    const bool called = !tools::ProgramFiles(config_.programs_folder()).find("O9003").empty();
    found += called ? 1 : 0;
    EXPECT_EQ(client.call("programs.list")["reply"]["programs"][0]["protected"], called);
    EXPECT_EQ(client.outcome("programs.rename", {{"name", name}, {"new_name", "other.nc"}}), called ? "protected" : "");
    EXPECT_EQ(client.outcome("programs.delete", {{"name", called ? name : "other.nc"}}), called ? "protected" : "");
    std::filesystem::remove(in_programs(name));
    const std::string answer = put(&client, name, "M30\n");
    EXPECT_EQ(answer.find("\"protected\"") != std::string::npos, called) << answer;
    std::filesystem::remove(in_programs(name));
  }
  EXPECT_EQ(found, 8u);
}

TEST_F(ProgramCheckServices, AnAlarmRefusesAProgramAndItsStart) {
  ServiceClient client(path_);
  take_control(&client);
  const Json report = put_and_check(&client, "bad.nc", "G0 X1.\nG1 X2. F100.\nG7.7\nM30\n");
  EXPECT_EQ(report["state"], "refused");
  ASSERT_EQ(report["alarms"].size(), 1u);
  EXPECT_EQ(report["alarms"][0]["line"], 3);
  EXPECT_EQ(report["alarms"][0]["program"], "bad.nc");
  EXPECT_NE(report["alarms"][0]["code"], "");
  ASSERT_EQ(client.outcome("select", {{"name", "bad.nc"}}), "");
  std::string why;
  EXPECT_EQ(start(&client, &why), "refused");
  EXPECT_NE(why.find("bad.nc line 3"), std::string::npos) << why;
  EXPECT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_IDLE);
  // Mended, it is checked again and runs.
  ASSERT_EQ(put(&client, "bad.nc", "G0 X1.\nM30\n", true), "");
  ASSERT_EQ(client.outcome("select", {{"name", "bad.nc"}}), "");
  EXPECT_EQ(start(&client), "");
}

TEST_F(ProgramCheckServices, APassedProgramStartsAgainAndAgain) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "part.nc", "G0 X1.\nG0 X0.\nM30\n"), "");
  ASSERT_EQ(client.outcome("select", {{"name", "part.nc"}}), "") << "the reply waits for the check";
  for (unsigned run = 1; run <= 3; ++run) {
    ASSERT_EQ(start(&client), "");
    until(&client, "status", [&](const Json&) { return runtime_->info().system[0].runs == run; });
  }
}

TEST_F(ProgramCheckServices, AProgramThatNobodyUploadedIsCheckedWhenItIsSelected) {
  write_program("copied.nc", "G0 X1.\nM30\n");
  write_program("wrong.nc", "G0 X1.\nG1 X2. F100. Q\n");
  ServiceClient client(path_);
  take_control(&client);
  EXPECT_EQ(client.call("programs.check", {{"name", "copied.nc"}})["reply"]["state"], "unchecked");
  ASSERT_EQ(client.outcome("select", {{"name", "wrong.nc"}}), "");
  EXPECT_EQ(start(&client), "refused");
  ASSERT_EQ(client.outcome("select", {{"name", "copied.nc"}}), "");
  EXPECT_EQ(start(&client), "");
}

TEST_F(ProgramCheckServices, TheRunningCopyIsNotTheOneOfTheFile) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "part.nc", "G0 X1.\nM30\n"), "");
  ASSERT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  write_program("part.nc", "G7.7\nM30\n");
  EXPECT_EQ(client.call("programs.recheck", {{"name", "part.nc"}})["ok"], true);
  EXPECT_EQ(checked(&client, "part.nc")["state"], "refused");
  EXPECT_EQ(start(&client), "") << "what was selected has passed";
}

// One that root has put into the folder is listed, but what is longer than a program may be is none.
TEST_F(ProgramCheckServices, AFileThatIsTooLongIsRefusedAtOnce) {
  write_program("huge.nc", "M30\n");
  write_program("caller.nc", "M98 <huge.nc>\nM30\n");
  std::filesystem::resize_file(in_programs("huge.nc"), 10'000'000'000);
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  const Json answer = client.call("select", {{"name", "huge.nc"}});
  EXPECT_EQ(answer["error"], "refused");
  EXPECT_NE(answer["text"].get<std::string>().find("has 10000000000 bytes, a program at most 4194304"), std::string::npos) << answer;
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "huge.nc"}}), "");
  const Json report = until(&client, "programs.check", [](const Json& now) { return now["state"] != "checking"; }, {{"name", "huge.nc"}});
  EXPECT_NE(report["text"].get<std::string>().find("10000000000 bytes"), std::string::npos) << report;
  ASSERT_EQ(client.outcome("select", {{"name", "caller.nc"}}), "");
  EXPECT_EQ(client.outcome("start"), "refused");
}

// A hole of gigabytes in a file is a block that is too long. To look for a number in it takes no longer than a check may take, and keeps nobody from ending the control.
class CheckOfAHole : public ProgramCheckServices {
 protected:
  std::string check_text() override { return "check_seconds = 1\n"; }
  std::string machine_text() override {
    std::string text = ProgramCheckServices::machine_text();
    const std::string small = "program_mb = 4\n";
    return text.replace(text.find(small), small.size(), "program_mb = 1000000\n");
  }
};

TEST_F(CheckOfAHole, IsNoBlock) {
  write_program("hole.nc", "");
  std::filesystem::resize_file(in_programs("hole.nc"), std::uintmax_t{64} << 30);
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "hole.nc"}}), "");
  const Json report = until(&client, "programs.check", [](const Json& now) { return now["state"] != "checking"; }, {{"name", "hole.nc"}});
  EXPECT_EQ(report["state"], "refused");
  EXPECT_EQ(report["text"].get<std::string>().find("hole.nc line 1: P33"), 0u) << report;
}

TEST_F(CheckOfAHole, TakesNoLongerThanACheckMay) {  // the number is looked for in all of it
  write_program("hole.nc", "GOTO 10\n");
  std::filesystem::resize_file(in_programs("hole.nc"), std::uintmax_t{64} << 30);
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "hole.nc"}}), "");
  const Json report = until(&client, "programs.check", [](const Json& now) { return now["state"] != "checking"; }, {{"name", "hole.nc"}});
  EXPECT_EQ(report["state"], "unchecked");
  EXPECT_EQ(report["text"].get<std::string>().find("not checked: too long"), 0u) << report;
  EXPECT_TRUE(report["alarms"].empty());
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "hole.nc"}, {"seconds", 86400}}), "");
  until(&client, "programs.check", [](const Json& now) { return now["state"] == "checking"; }, {{"name", "hole.nc"}});
}  // the end of the control does not wait for it

// Who has changed a program that is selected is told that a start goes on with the text of before.
TEST_F(ProgramCheckServices, AChangeOfASelectedProgramSaysThatItIsSelected) {
  ServiceClient client(path_);
  take_control(&client);
  const auto text = [&](const char* service, const Json& args) {
    const Json reply = client.call(service, args);
    EXPECT_EQ(reply["ok"], true) << reply;
    return reply["reply"].value("text", "?");
  };
  const auto empty = [&](const std::string& name) {
    const Json begun = client.call("programs.begin", {{"name", name}, {"size", 0}, {"sha256", rt::services::Sha256().finish()}, {"replace", true}});
    return text("programs.finish", {{"upload", begun["reply"]["upload"]}});
  };
  const std::string warning = "part.nc is selected: a start does not know of this change before a program is selected again";
  ASSERT_EQ(put(&client, "part.nc", "G0 X1.\nM30\n"), "");
  EXPECT_EQ(empty("part.nc"), "") << "nothing is selected";
  ASSERT_EQ(put(&client, "part.nc", "G0 X1.\nM30\n", true), "");
  ASSERT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  EXPECT_EQ(empty("part.nc"), warning);
  EXPECT_EQ(empty("other.nc"), "");
  EXPECT_EQ(text("programs.protect", {{"name", "part.nc"}, {"on", false}}), "");
  EXPECT_EQ(text("programs.rename", {{"name", "part.nc"}, {"new_name", "next.nc"}}), warning);
  EXPECT_EQ(text("programs.rename", {{"name", "next.nc"}, {"new_name", "part.nc"}}), "");
  EXPECT_EQ(text("programs.delete", {{"name", "part.nc"}}), warning);
  ASSERT_EQ(start(&client), "") << "it has passed";
}

TEST_F(ProgramCheckServices, FollowsCallsIntoTheStore) {
  ServiceClient client(path_);
  Json report = put_and_check(&client, "main.nc", "G0 X1.\nM98 P77\nM30\n");
  EXPECT_EQ(report["state"], "refused") << "there is no O77 yet";
  EXPECT_EQ(report["alarms"][0]["line"], 2);
  // What was refused may have missed it.
  ASSERT_EQ(put(&client, "O77.nc", "G0 Y25.\nM99\n"), "");
  report = until(&client, "programs.check", [](const Json& reply) { return reply["state"] == "passed"; }, {{"name", "main.nc"}});
  EXPECT_NEAR(report["axes"][1]["most"].get<double>(), 25, 1e-9);
  // A change of what it calls ends what was found.
  ASSERT_EQ(put(&client, "O77.nc", "G0 Y25.\nG7.7\nM99\n", true), "");
  until(&client, "programs.check", [](const Json& reply) { return reply["state"] == "unchecked"; }, {{"name", "main.nc"}});
  EXPECT_EQ(client.outcome("programs.recheck", {{"name", "main.nc"}}), "");
  report = checked(&client, "main.nc");
  EXPECT_EQ(report["state"], "refused");
  EXPECT_EQ(report["alarms"][0]["program"], "O77.nc");
  EXPECT_EQ(report["alarms"][0]["line"], 2);
}

// The files are looked at while another program is being checked, which may take a minute: a start must not slip in behind a sub program that has changed meanwhile.
TEST_F(ProgramCheckServices, WhatIsCalledIsLookedAtWhileAnotherProgramIsChecked) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "main.nc", "G0 X1.\nM98 P1000\nM30\n", true), "");
  ASSERT_EQ(put(&client, "O1000.nc", "G1 X10. F600.\nM99\n", true), "");
  ASSERT_EQ(client.outcome("select", {{"name", "main.nc"}}), "");
  ASSERT_EQ(checked(&client, "main.nc")["state"], "passed");
  ASSERT_EQ(put(&client, "long.nc", "N10 G0 X10.\nX0\n#500=#500+1\nIF[#500LT2000000000]GOTO 10\nM30\n", true), "");
  until(&client, "programs.check", [](const Json& reply) { return reply["state"] == "checking"; }, {{"name", "long.nc"}});
  write_program("O1000.nc", "G1 X99999. F600.\nM99\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(start(&client), "refused");
  EXPECT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_IDLE);
  EXPECT_EQ(client.call("programs.check", {{"name", "long.nc"}})["reply"]["state"], "checking") << "the check was to be under way";
}

// A program that is selected and has passed is not begun when what it calls has become another one: also where its own file was touched before, or what was found is kept
// no more, and where a file comes that is found in front of the one that was checked.
TEST_F(ProgramCheckServices, WhatIsCalledIsWhatWasChecked) {
  ServiceClient client(path_);
  take_control(&client);
  const auto selected = [&] {
    ASSERT_EQ(put(&client, "main.nc", "G0 X1.\nM98 P1000\nM30\n", true), "");
    ASSERT_EQ(put(&client, "O1000.nc", "G1 X10. F600.\nM99\n", true), "");
    std::filesystem::remove(in_programs("O1000"));
    ASSERT_EQ(client.outcome("select", {{"name", "main.nc"}}), "");
    EXPECT_EQ(checked(&client, "main.nc")["state"], "passed");
  };
  const auto refused = [&](const std::string& what) {
    SCOPED_TRACE(what);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(start(&client), "refused");
    EXPECT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_IDLE);
  };
  ASSERT_NO_FATAL_FAILURE(selected());
  write_program("main.nc", "G0 X1.\nM98 P1000\nM30\n(touched)\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // what was found of its file is forgotten by now
  write_program("O1000.nc", "G1 X99999. F600.\nM99\n");
  refused("touched, then another sub program");
  ASSERT_NO_FATAL_FAILURE(selected());
  write_program("O1000", "G1 X99999. F600.\nM99\n");
  refused("a file in front of the one that was found");
  ASSERT_NO_FATAL_FAILURE(selected());
  write_program("O1000.nc", "G1 X99999. F600.\nM99\n");
  refused("another sub program");
}

// Right behind the change, and not only when the files have been looked at the next time.
TEST_F(ProgramCheckServices, AStartBehindAChangeOfWhatIsCalledWaitsForItsCheck) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "main.nc", "G0 X1.\nM98 P1000\nM30\n", true), "");
  for (int n = 0; n < 8; ++n) {
    SCOPED_TRACE(n);
    ASSERT_EQ(put(&client, "O1000.nc", "G1 X10. F600.\nM99\n", true), "");
    ASSERT_EQ(client.outcome("select", {{"name", "main.nc"}}), "");
    ASSERT_EQ(checked(&client, "main.nc")["state"], "passed");
    until(&client, "programs.check", [](const Json& reply) { return reply["state"] == "passed"; }, {{"name", "main.nc"}});
    const std::string bad = "G1 X99999. F600.\nM99\n";
    if (n % 2 == 0) ASSERT_EQ(put(&client, "O1000.nc", bad, true), "");
    else write_program("O1000.nc", bad);  // by another program, of which the services do not know
    ASSERT_EQ(start(&client), "refused");
    ASSERT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_IDLE);
  }
}

// A start that goes on behind a stop looks at no check, so what the program calls stays as it was checked until a reset.
TEST_F(ProgramCheckServices, WhatIsCalledStaysWhileItsProgramIsInExecution) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "main.nc", "G0 X1.\nM0\nM98 P1000\nM30\n", true), "");
  ASSERT_EQ(put(&client, "O1000.nc", "G1 X10. F600.\nM99\n", true), "");
  ASSERT_EQ(put(&client, "other.nc", "M30\n", true), "");
  ASSERT_EQ(client.outcome("select", {{"name", "main.nc"}}), "");
  ASSERT_EQ(checked(&client, "main.nc")["state"], "passed");
  ASSERT_EQ(start(&client), "");
  until(&client, "status", [&](const Json&) { return runtime_->snapshot().system[0].nc.state == NC_STATE_STOPPED; });
  EXPECT_NE(put(&client, "O1000.nc", "G1 X20. F600.\nM99\n", true).find("\"protected\""), std::string::npos);
  EXPECT_EQ(client.outcome("programs.delete", {{"name", "O1000.nc"}}), "protected");
  EXPECT_EQ(client.outcome("programs.rename", {{"name", "O1000.nc"}, {"new_name", "x.nc"}}), "protected");
  EXPECT_EQ(put(&client, "other.nc", "G0 X0\nM30\n", true), "");
  ASSERT_EQ(client.outcome("reset"), "");
  EXPECT_EQ(put(&client, "O1000.nc", "G1 X20. F600.\nM99\n", true), "");
}

// Right behind a change of its file by another program: what was found of the old text says nothing of the new one.
TEST_F(ProgramCheckServices, ASelectionBehindAnEditIsCheckedAnew) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "i.nc", "G0 X1.\nM30\n", true), "");
  EXPECT_EQ(checked(&client, "i.nc")["state"], "passed");
  for (int n = 0; n < 5; ++n) {
    write_program("i.nc", "G0 X" + std::to_string(n) + ".\nM30\n");
    ASSERT_EQ(client.outcome("select", {{"name", "i.nc"}}), "");
    EXPECT_EQ(checked(&client, "i.nc")["state"], "passed");  // on a busy computer a check takes longer than the reply to the selection waits for it
    ASSERT_EQ(start(&client), "");
    until(&client, "status", [&](const Json&) { return runtime_->info().system[0].runs > static_cast<unsigned>(n) && runtime_->snapshot().system[0].nc.state == NC_STATE_IDLE; });
  }
}

TEST_F(ProgramCheckServices, GoesByThePresentTables) {
  ServiceClient client(path_);
  const char* text = "G54\nG0 X10.\nIF[#501GT5]GOTO9\nM30\nN9 G7.7\nM30\n";
  EXPECT_EQ(put_and_check(&client, "tables.nc", text)["state"], "passed");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "X"}, {"value", 100}}), "");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 7}}), "");
  EXPECT_EQ(client.call("programs.check", {{"name", "tables.nc"}})["reply"]["state"], "passed") << "it says what was found then";
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "tables.nc"}}), "");
  const Json report = checked(&client, "tables.nc");
  EXPECT_EQ(report["state"], "refused");
  EXPECT_NEAR(report["axes"][0]["most"].get<double>(), 110, 1e-9);
}

TEST_F(ProgramCheckServices, BehindAQuestionToTheMachineAnAlarmDoesNotRefuse) {
  ServiceClient client(path_);
  Json report = put_and_check(&client, "asks.nc", "G0 X1.\nIF[#1000EQ1]GOTO5\nG7.7\nN5 M30\n");
  EXPECT_EQ(report["state"], "passed") << report;
  EXPECT_EQ(report["asks_line"], 2);
  EXPECT_EQ(report["asks_program"], "asks.nc");
  ASSERT_EQ(report["alarms"].size(), 1u);
  EXPECT_EQ(report["alarms"][0]["line"], 3);
  report = put_and_check(&client, "waits.nc", "G0 X1.\nN1 IF[#1000EQ0]GOTO1\nM30\n");
  EXPECT_EQ(report["state"], "passed") << report;
  EXPECT_NE(report["text"].get<std::string>().find("waits for the machine"), std::string::npos) << report;
}

TEST_F(ProgramCheckServices, EndlessProgramsEndTheirCheck) {
  ServiceClient client(path_);
  const Json again = put_and_check(&client, "turns.nc", "N1 GOTO1\n");
  EXPECT_EQ(again["state"], "passed");
  const std::string text = again["text"].get<std::string>();
  EXPECT_EQ(text.rfind("it goes on until a reset: line 1: 1", 0), 0u) << text;
  EXPECT_EQ(text.find("--"), std::string::npos) << "an operator has no options: " << text;
  EXPECT_EQ(put_and_check(&client, "silent.nc", "N1 #100=#100+1\nGOTO1\n")["state"], "unchecked");
  EXPECT_EQ(put_and_check(&client, "warm.nc", "WHILE[1EQ1]DO1\nG0 X1.\nG0 X0.\nEND1\n")["state"], "passed");
  EXPECT_EQ(put_and_check(&client, "again.nc", "G0 X1.\nG0 X0.\nM99\n")["state"], "passed");
}

// Strangers' programs count their parts and jump back: a state that never comes again, and no end in what is written.
TEST_F(ProgramCheckServices, ALoopThatCountsPartsPassesWithTheRoundsThatWereChecked) {
  ServiceClient client(path_);
  take_control(&client);
  const std::string holes = "#1=0\nWHILE[#1LT5]DO1\nG0 X[10.*#1]\nG1 Z-1. F600\nG0 Z2.\n#1=#1+1\nEND1\n";
  for (const std::string& text : {std::string("G90 G54\nN1 ") + holes + "#500=#500+1\nGOTO1\nM30\n", "G90 G54\nDO2\n" + holes + "#500=#500+1\nEND2\nM30\n", std::string("G90 G54\nN1 G0 X5.\nG0 X0.\n#500=#500+1\nIF[#500LT3]GOTO2\nM8\nN2 GOTO1\nM30\n")}) {
    const Json report = put_and_check(&client, "counts.nc", text);
    EXPECT_EQ(report["state"], "passed") << text << report;
    const std::string said = report["text"].get<std::string>();
    EXPECT_EQ(said.rfind("it goes on until a reset: line ", 0), 0u) << said;
    EXPECT_NE(said.find("1000 rounds of the loop back to line "), std::string::npos) << said;
    EXPECT_NE(said.find("later ones are not checked"), std::string::npos) << said;
  }
  ASSERT_EQ(client.outcome("select", {{"name", "counts.nc"}}), "");
  std::string why;
  EXPECT_EQ(start(&client, &why), "") << why;
}

TEST_F(ProgramCheckServices, AnOffsetThatGrowsEachRoundIsFoundOrItsRoundsAreSaid) {
  ServiceClient client(path_);
  const auto grows = [&](const char* by) { return put_and_check(&client, "grows.nc", std::string("G90 G54\nN1 G0 X5.\nG0 X0.\nG91 G10 L2 P1 X") + by + "\nG90\nGOTO1\nM30\n"); };
  const Json fast = grows("1.");
  EXPECT_EQ(fast["state"], "refused") << fast;
  EXPECT_NE(fast["text"].get<std::string>().find("X"), std::string::npos) << fast;
  const Json slow = grows("0.01");
  EXPECT_EQ(slow["state"], "passed") << slow;
  EXPECT_NE(slow["text"].get<std::string>().find("1000 rounds"), std::string::npos) << slow;
}

// A count to a large number has an end, however far it is, and behind it stand blocks that nobody has looked at.
TEST_F(ProgramCheckServices, ALoopWithAWayOutIsALongProgram) {
  ServiceClient client(path_);
  for (const char* text : {"N1 G0 X5.\nG0 X0.\n#500=#500+1\nIF[#500GT2000000000]GOTO9\nGOTO1\nN9 M30\n", "N1 G0 X5.\nG0 X0.\n#500=#500+1\nIF[#500LT2000000000]GOTO1\nM30\n",
                           "N1 G0 X5.\nG0 X0.\n#500=#500+1\nIF[#500LT2000000000]GOTO2\nM30\nN2 GOTO1\n", "N1 G0 X5.\nM98 P1000\n#500=#500+1\nGOTO1\nM30\nO1000\nIF[#500LT2000000000]GOTO5\nM30\nN5 M99\n"}) {
    ASSERT_EQ(put(&client, "long.nc", text, true), "");
    ASSERT_EQ(client.outcome("programs.recheck", {{"name", "long.nc"}, {"seconds", 1}}), "");
    const Json report = checked(&client, "long.nc");
    EXPECT_EQ(report["state"], "unchecked") << text << report;
    ASSERT_EQ(client.outcome("programs.delete", {{"name", "long.nc"}}), "");
  }
}

// Whether it goes on the machine says, in each round.
TEST_F(ProgramCheckServices, ALoopThatAsksTheMachineAndCountsPassesWhenItsTimeIsOver) {
  ServiceClient client(path_);
  ASSERT_EQ(put(&client, "until.nc", "WHILE[#1000EQ0]DO1\nG0 X5.\nG0 X0.\n#500=#500+1\nEND1\nM30\n"), "");
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "until.nc"}, {"seconds", 1}}), "");
  const Json report = checked(&client, "until.nc");
  EXPECT_EQ(report["state"], "passed") << report;
  EXPECT_NE(report["text"].get<std::string>().find("line 1 asks the machine"), std::string::npos) << report;
}

TEST_F(ProgramCheckServices, WhatTakesTooLongIsNotChecked) {
  ServiceClient client(path_);
  ASSERT_EQ(put(&client, "long.nc", "#100=0\nWHILE[#100LT2000000000]DO1\n#100=#100+1\nG0 X1.\nG0 X0.\nEND1\nM30\n"), "");
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "long.nc"}, {"seconds", 1}}), "");
  const Json report = checked(&client, "long.nc");
  EXPECT_EQ(report["state"], "unchecked");
  EXPECT_NE(report["text"].get<std::string>().find("not checked: too long"), std::string::npos) << report;
  take_control(&client);  // not before the check, which may take longer than control is kept
  ASSERT_EQ(client.outcome("select", {{"name", "long.nc"}}), "");
  std::string why;
  EXPECT_EQ(start(&client, &why), "refused");
  EXPECT_NE(why.find("too long"), std::string::npos) << why;
}

TEST_F(ProgramCheckServices, ADeletedProgramEndsItsCheckAndThoseBehindItCome) {
  ServiceClient client(path_);
  const char* text = "#100=0\nWHILE[#100LT2000000000]DO1\n#100=#100+1\nG0 X1.\nG0 X0.\nEND1\nM30\n";
  for (const char* name : {"a.nc", "b.nc"}) ASSERT_EQ(put(&client, name, text), "");
  for (const char* name : {"c.nc", "d.nc"}) ASSERT_EQ(put(&client, name, "G0 X1.\nM30\n"), "");
  EXPECT_EQ(client.call("programs.check", {{"name", "c.nc"}})["reply"]["state"], "checking") << "one after the other";
  ASSERT_EQ(client.outcome("programs.delete", {{"name", "a.nc"}}), "");
  ASSERT_EQ(put(&client, "b.nc", "G0 X1.\nM30\n", true), "");
  for (const char* name : {"b.nc", "c.nc", "d.nc"}) EXPECT_EQ(checked(&client, name)["state"], "passed") << name;
  EXPECT_EQ(client.outcome("programs.check", {{"name", "a.nc"}}), "not found");
  ASSERT_EQ(client.outcome("programs.rename", {{"name", "c.nc"}, {"new_name", "e.nc"}}), "");
  EXPECT_EQ(checked(&client, "e.nc")["state"], "passed");
}

TEST_F(ProgramCheckServices, TheMachineIsAsItWasBehindACheck) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("variables.set", {{"number", 502}, {"value", 1}}), "");
  const Json before = client.call("variables.list"), place = client.call("status")["reply"]["systems"][0]["axes"];
  EXPECT_EQ(put_and_check(&client, "sets.nc", "#502=99\nG10 L2 P1 X5.\nG0 X50.\nM30\n")["state"], "passed");
  EXPECT_EQ(client.call("variables.list")["reply"], before["reply"]);
  EXPECT_EQ(client.call("offsets.list", {{"count", 1}, {"from", 1}})["ok"], true);
  EXPECT_EQ(client.call("status")["reply"]["systems"][0]["axes"], place);
}

TEST_F(ProgramCheckServices, BlocksOfMdiAreNotChecked) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G0 X1."}}), "");
  EXPECT_EQ(start(&client), "");
}

TEST_F(ProgramCheckWarns, AStartIsTakenWithAMessage) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "bad.nc", "G0 X0.5\nG7.7\nM30\n"), "");
  const Json selected = client.call("select", {{"name", "bad.nc"}});
  EXPECT_NE(selected["reply"]["text"].get<std::string>().find("refused by its check"), std::string::npos) << selected;
  (void)start(&client);  // it may have come to its alarm already
  const auto told = [this] {
    for (const auto& said : runtime_->info().said)
      if (said.text.find("bad.nc was refused by its check") != std::string::npos) return true;
    return false;
  };
  until(&client, "status", [&](const Json&) { return told(); });
  EXPECT_TRUE(told());
}

TEST_F(ProgramCheckOff, NothingIsCheckedBeforeSomebodyAsks) {
  ServiceClient client(path_);
  take_control(&client);
  ASSERT_EQ(put(&client, "part.nc", "G0 X1.\nM30\n"), "");
  ASSERT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  EXPECT_EQ(client.call("programs.check", {{"name", "part.nc"}})["reply"]["state"], "unchecked");
  EXPECT_EQ(start(&client), "");
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "part.nc"}}), "");
  EXPECT_EQ(checked(&client, "part.nc")["state"], "passed");
}

TEST(ProgramCheckConfig, KnowsThreePolicies) {
  EXPECT_EQ(parse_or_fail(base_toml()).services.check, rt::ProgramCheck::kRequired);
  EXPECT_EQ(parse_or_fail(base_toml() + "[services]\ncheck = \"warn\"\ncheck_seconds = 5\n").services.check, rt::ProgramCheck::kWarn);
  for (const char* bad : {"check = \"maybe\"", "check = true", "check_seconds = 0"}) {
    rt::Config config;
    EXPECT_FALSE(rt::parse_config(base_toml() + "[services]\n" + bad + "\n", "test.toml", &config).empty()) << bad;
  }
}

}  // namespace
}  // namespace nc::test
