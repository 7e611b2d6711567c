// SPDX-License-Identifier: Apache-2.0
// G and M codes of the machine's maker (nc_config::vendor_codes): what they call, when and with which data; which tables are refused.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>

#include "control/online_helpers.hpp"

namespace nc::test {
namespace {

/// The calls of the function with their data, and the answer that it gives.
struct Host {
  std::vector<std::string> calls;
  nc_status answer = NC_OK;
  std::function<void(nc_control*, const nc_vendor_block&, nc_alarm*)> act;
};

nc_status called(void* user, nc_control* control, const nc_vendor_block* block, nc_alarm* alarm) {
  Host& host = *static_cast<Host*>(user);
  std::string text = block->letter + std::to_string(block->number) + (block->online ? " online" : "") + " line " + std::to_string(block->source.line) + " at " +
                     brief(block->machine.v[0]) + ":";
  for (uint32_t i = 0; i < block->word_count; ++i) text += std::string(" ") + block->words[i].address + brief(block->words[i].value);
  EXPECT_EQ(block->struct_size, sizeof *block);
  EXPECT_EQ(block->source.system, 0);
  host.calls.push_back(text);
  if (host.act) host.act(control, *block, alarm);
  return host.answer;
}

nc_vendor_code function(char letter, uint32_t number, Host* host, bool override_dialect = false) {
  nc_vendor_code code{};
  code.letter = letter;
  code.number = number;
  code.override_dialect = override_dialect;
  code.function = called;
  code.user = host;
  return code;
}

nc_vendor_code program(char letter, uint32_t number, uint32_t o, nc_call_type call) {
  nc_vendor_code code{};
  code.letter = letter;
  code.number = number;
  code.program = o;
  code.call = call;
  return code;
}

std::function<void(nc_config&)> with(const std::vector<nc_vendor_code>& codes) {
  return [&codes](nc_config& c) {
    c.vendor_codes = codes.data();
    c.vendor_code_count = static_cast<uint32_t>(codes.size());
  };
}

using Calls = std::vector<std::string>;

TEST(VendorCodes, TheFunctionGetsTheWordsWhenEverythingBeforeHasHappened) {
  Host host;
  const std::vector<nc_vendor_code> codes = {function('G', 2001, &host), function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  const Outcome run = bench.run("G1 X5. F100\n#1=4.5\nN7 G91 G200.1 X#1 Y[1+1] Z#2 P3\nX1.\nG90 M500\nG1 X2.\nM30");
  EXPECT_EQ(run.status, NC_ENDED);
  EXPECT_EQ(host.calls, (Calls{"G2001 line 3 at 5: X4.5 Y2 P3", "M500 line 5 at 6:"}));
  EXPECT_EQ(run.moves().size(), 3u) << "the words of the block moved nothing; G91 before the code acts";
  EXPECT_EQ(run.of(NC_ITEM_SYNC).size(), 2u);
  for (const nc_item& item : run.of(NC_ITEM_ACTION)) EXPECT_EQ(item.u.action.value, 30) << "M500 does not go out";
  EXPECT_EQ(run.end_work.v[0], 2);
}

TEST(VendorCodes, ItsMarkShowsTheMCode) {
  Host host;
  const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  const Outcome run = bench.run("M500\n#100=#4113\nM30");
  EXPECT_EQ(run.var(100), 500);
}

TEST(VendorCodes, TheFunctionMayUseTheTables) {
  Host host;
  host.act = [](nc_control* control, const nc_vendor_block& block, nc_alarm*) {
    double value = 0;
    bool vacant = true;
    EXPECT_EQ(nc_variable_get(control, 0, 100, &value, &vacant), NC_OK);
    EXPECT_EQ(nc_variable_set(control, 0, 101, value + block.words[0].value, false), NC_OK);
    EXPECT_EQ(nc_tool_offset_set(control, 3, NC_TOOL_LENGTH, 12), NC_OK);
  };
  const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  const Outcome run = bench.run("#100=2\nM500 P5\n#102=#101*10 #103=#10003\nM30");
  EXPECT_EQ(run.var(102), 70);
  EXPECT_EQ(run.var(103), 12);
}

TEST(VendorCodes, NothingElseDrivesThePartSystemMeanwhile) {
  Host host;
  host.act = [](nc_control* control, const nc_vendor_block&, nc_alarm*) {
    nc_item item;
    nc_world world{};
    nc_axes axes{};
    bool back = false;
    EXPECT_EQ(nc_pull(control, 0, 10, &item), NC_E_STATE);
    EXPECT_EQ(nc_feed(control, 10), NC_E_STATE);
    EXPECT_EQ(nc_answer(control, 0, &world), NC_E_STATE);
    EXPECT_EQ(nc_rewind(control, 0, 0), NC_E_STATE);
    EXPECT_EQ(nc_recalculate(control, 0), NC_E_STATE);
    EXPECT_EQ(nc_reset(control, 0), NC_E_STATE);
    EXPECT_EQ(nc_program_select(control, 0, 0), NC_E_STATE);
    EXPECT_EQ(nc_mdi_load(control, 0, "X1.", 3), NC_E_STATE);
    EXPECT_EQ(nc_position_set(control, 0, &axes), NC_E_STATE);
    EXPECT_EQ(nc_interrupt_signal(control, 0, true, &back), NC_E_STATE);
  };
  const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  const Outcome run = bench.run("M500\nG0 X1.\nM30");
  EXPECT_EQ(run.status, NC_ENDED);
  EXPECT_EQ(host.calls.size(), 1u);
}

TEST(VendorCodes, AFunctionThatFailsStopsTheProgram) {
  Host host;
  host.answer = NC_E_STATE;
  const std::vector<nc_vendor_code> codes = {function('G', 2000, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  Outcome run = bench.run("G0 X1.\nG91 G200 X2.\nG0 X9.\nM30");
  EXPECT_EQ(run.status, NC_ALARMED);
  EXPECT_EQ(run.alarm, "NC-VENDOR");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_NE(run.alarm_detail.find("G200"), std::string::npos) << run.alarm_detail;
  EXPECT_FALSE(run.alarm_message.empty());
  EXPECT_EQ(run.moves().size(), 1u);
  host.act = [](nc_control*, const nc_vendor_block&, nc_alarm* alarm) {
    std::strcpy(alarm->code, "V12");
    std::strcpy(alarm->message, "Door is open");
    std::strcpy(alarm->detail.s, "Close the door, then start again.");
    alarm->source.line = 77;  // the library writes the line itself
  };
  run = bench.run("G200\nM30");
  EXPECT_EQ(run.alarm, "V12");
  EXPECT_EQ(run.alarm_message, "Door is open");
  EXPECT_EQ(run.alarm_detail, "Close the door, then start again.");
  EXPECT_EQ(run.alarm_line, 1u);
  host.answer = NC_OK;  // an alarm that it has written does not count then
  EXPECT_EQ(bench.run("G200\nM30").alarm, "");
}

TEST(VendorCodes, TextsWithoutEndEnd) {
  Host host;
  host.answer = NC_ALARMED;
  host.act = [](nc_control*, const nc_vendor_block&, nc_alarm* alarm) {
    std::memset(alarm->code, 'V', sizeof alarm->code);
    std::memset(alarm->message, 'm', sizeof alarm->message);
    alarm->message[sizeof alarm->message - 2] = static_cast<char>(0xc3);  // the letter u-umlaut, of which only the first byte fits
    alarm->message[sizeof alarm->message - 1] = static_cast<char>(0xbc);
    std::memset(alarm->detail.s, 'd', sizeof alarm->detail.s);
  };
  const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  const Outcome run = bench.run("M500\nM30");
  EXPECT_EQ(run.alarm, std::string(15, 'V'));
  EXPECT_EQ(run.alarm_message, std::string(62, 'm'));
  EXPECT_EQ(run.alarm_detail, std::string(127, 'd'));
  host.act = [](nc_control*, const nc_vendor_block&, nc_alarm* alarm) { *alarm = nc_alarm{}; };
  EXPECT_EQ(bench.run("M500\nM30").alarm, "NC-VENDOR") << "an alarm has a code";
}

TEST(VendorCodes, ProgramsAreCalledAsByRegisteredCodes) {
  const std::vector<nc_vendor_code> codes = {program('G', 2001, 9010, NC_CALL_MACRO), program('M', 60, 9020, NC_CALL_SUB), program('G', 2100, 9030, NC_CALL_MODAL)};
  Bench bench(NC_DIALECT_M700, with(codes));
  bench.add("O9010", "#100=#24+#25\nM99\n");
  bench.add("O9020", "#101=#101+1\nM99\n");
  bench.add("O9030", "#102=#102+1\nM99\n");
  const Outcome run = bench.run("#101=0 #102=0\nG200.1 X1. Y2.\nM60\nG1 X3. F100 M60\nG210\nX4.\nX5.\nG67\nX6.\nM30");
  EXPECT_EQ(run.status, NC_ENDED) << run.alarm << run.alarm_detail;
  EXPECT_EQ(run.var(100), 3);
  EXPECT_EQ(run.var(101), 2);
  EXPECT_EQ(run.var(102), 2);
}

TEST(VendorCodes, AFunctionIsCalledInsideAProgramThatACodeHasCalled) {
  Host host;
  const std::vector<nc_vendor_code> codes = {program('M', 60, 9020, NC_CALL_SUB), function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  bench.add("O9020", "M500\nM60\nM99\n");
  const Outcome run = bench.run("M60\nM30");
  EXPECT_EQ(run.status, NC_ENDED);
  EXPECT_EQ(host.calls.size(), 1u);
  ASSERT_EQ(run.of(NC_ITEM_ACTION).size(), 2u) << "M60 in there is an ordinary code (M700 13.5.2)";
  EXPECT_EQ(run.of(NC_ITEM_ACTION)[0].u.action.value, 60);
}

TEST(VendorCodes, TakeThePlaceOfCodesOfTheDialectWhereTheySaySo) {
  Host host;
  const std::vector<nc_vendor_code> codes = {function('G', 10, &host, true), function('M', 3, &host, true), function('G', 40, &host, true)};
  Bench bench(NC_DIALECT_M700, with(codes));
  const Outcome run = bench.run("F100\nG1 X5.\nM3\nG04 X1.\nM30");
  EXPECT_EQ(host.calls, (Calls{"G10 line 2 at 0: X5", "M3 line 3 at 0:", "G40 line 4 at 0: X1"}));
  EXPECT_TRUE(run.moves().empty());
}

TEST(VendorCodes, OfADialectWithoutMacros) {
  Host host;
  const std::vector<nc_vendor_code> codes = {function('M', 50, &host)};
  Bench bench(NC_DIALECT_DGSHAPE, with(codes));
  const Outcome run = bench.run("%\nG0 X1.\nM50\nM30\n%");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(host.calls, (Calls{"M50 line 3 at 1:"}));
}

TEST(VendorCodes, OnTheMachineEachBlockCallsOnce) {
  Host host;
  const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, [&](nc_config& c) {
    machine(64)(c);
    with(codes)(c);
  });
  std::vector<double> stood;
  nc_outputs out{};
  host.act = [&](nc_control*, const nc_vendor_block& block, nc_alarm*) {
    EXPECT_TRUE(block.online);
    stood.push_back(block.machine.v[0]);
    EXPECT_NEAR(out.command.v[0], block.machine.v[0], 1e-9) << "the machine stands there";
  };
  bench.start("G1 X5. F60000\nM500\nX8.\nM500\nX9.\nM30");
  nc_inputs in;
  nc_inputs_init(&in);
  for (unsigned n = 0; n < 2000 && (out.blocks < 6 || n < 10); ++n) {
    nc_feed(bench.control(), 100);
    in.cycle_start = n == 2;
    in.fin = out.strobe != 0;
    in.recalculate = n % 3 == 0;  // so that blocks are read again and again
    ASSERT_EQ(nc_cycle(bench.control(), &in, &out), NC_OK);
  }
  EXPECT_EQ(stood, (std::vector<double>{5, 8}));
  EXPECT_EQ(out.command.v[0], 9);
}

// The feeder has called the function, and before the scan has reached the end of that block the program is read again from there.
TEST(VendorCodes, WhatIsReadAgainBeforeItsEndCallsOnce) {
  unsigned again = 0;
  for (unsigned hold = 2; hold < 40; ++hold) {
    for (const bool single : {false, true}) {
      Host host;
      const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
      Bench bench(NC_DIALECT_M700, [&](nc_config& c) {
        machine(64)(c);
        with(codes)(c);
      });
      bench.start("G1 X5. F60000\nM500\nX8.\nM500\nX9.\nM30");
      nc_inputs in;
      nc_inputs_init(&in);
      nc_outputs out{};
      in.single_block = single;
      for (unsigned n = 0; n < 400 && (out.blocks < 6 || n < 10); ++n) {
        nc_feed(bench.control(), 100);
        if (n >= hold && n < hold + 6) again += nc_recalculate(bench.control(), 0) == NC_OK;
        in.feed_hold = n >= hold && n < hold + 6;
        in.cycle_start = n == 2 || n % 8 == 0;
        in.fin = out.strobe != 0;
        ASSERT_EQ(nc_cycle(bench.control(), &in, &out), NC_OK);
      }
      EXPECT_EQ(host.calls.size(), 2u) << hold << single;
      EXPECT_EQ(out.command.v[0], 9) << hold << single;
    }
  }
  EXPECT_GT(again, 50u);
}

TEST(VendorCodes, AnInterruptAtAnyTimeLeavesItAtOneCall) {
  unsigned interrupts = 0;
  for (const char* at_once : {"0", "1"}) {
    for (unsigned signal = 4; signal < 60; ++signal) {
      Host host;
      const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
      Bench bench(NC_DIALECT_M700, [&](nc_config& c) {
        machine(64)(c);
        with(codes)(c);
      });
      bench.param("1109", "0").param("1113", at_once);
      bench.add("O1000", "#100=1\nM99\n");
      bench.start("M96 P1000\nG1 X5. F60000\nM500\nX8.\nM500\nX9.\nM97\nM30");
      nc_inputs in;
      nc_inputs_init(&in);
      nc_outputs out{};
      for (unsigned n = 0; n < 400 && (out.state != NC_STATE_IDLE || n < 10); ++n) {
        nc_feed(bench.control(), 100);
        in.macro_interrupt = n == signal;
        in.cycle_start = n == 2;
        in.fin = out.strobe != 0;
        ASSERT_EQ(nc_cycle(bench.control(), &in, &out), NC_OK);
      }
      interrupts += bench.var_now(100) == 1;
      EXPECT_EQ(host.calls.size(), 2u) << at_once << " " << signal;
      EXPECT_EQ(out.command.v[0], 9) << signal;
    }
  }
  EXPECT_GT(interrupts, 20u);
}

TEST(VendorCodes, GoingBackOfflineCallsAgain) {
  Host host;
  const std::vector<nc_vendor_code> codes = {function('M', 500, &host)};
  Bench bench(NC_DIALECT_M700, with(codes));
  bench.run("G0 X1.\nM500\nG0 X2.\nM30");
  ASSERT_EQ(bench.rewind(0, nc_axes{}), NC_OK);
  bench.finish();
  EXPECT_EQ(host.calls.size(), 2u);
}

// ---- tables that are refused --------------------------------------------------------------------------------------------------

std::string refused(const std::vector<nc_vendor_code>& codes, nc_dialect dialect = NC_DIALECT_M700) {
  nc_config config;
  nc_config_init(&config);
  config.dialect = static_cast<uint8_t>(dialect);
  with(codes)(config);
  nc_config_fault fault;
  if (nc_config_check(&config, &fault) == NC_OK) return "";
  EXPECT_EQ(nc_memory_required(&config), 0u);
  return std::string(fault.field) + " " + fault.reason;
}

TEST(VendorCodes, WhatIsRefusedIsNamed) {
  Host host;
  const auto begins = [](const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; };
  EXPECT_EQ(refused({function('M', 2000, &host), function('G', 2000, &host)}), "") << "one is M2000, the other G200";
  for (const auto& [code, number] : {std::pair{'G', 10u}, {'G', 541u}, {'M', 3u}, {'M', 4u}})
    EXPECT_TRUE(begins(refused({function(code, number, &host)}), "vendor_codes[0].number is a code of the dialect")) << code << number;
  for (const auto& [code, number] : {std::pair{'M', 0u}, {'M', 30u}, {'M', 98u}, {'M', 99u}, {'G', 650u}, {'G', 100u}, {'G', 670u}})
    EXPECT_TRUE(begins(refused({function(code, number, &host, true)}), "vendor_codes[0].number is a code that programs")) << code << number;
  EXPECT_EQ(refused({function('G', 2000, &host)}), "") << "G100 to G255 are for registering";
  EXPECT_EQ(refused({function('M', 500, &host), function('M', 500, &host)}), "vendor_codes[1].number is the code of a row before it");
  EXPECT_TRUE(begins(refused({function('X', 500, &host)}), "vendor_codes[0].letter"));
  EXPECT_TRUE(begins(refused({function('G', 10000, &host)}), "vendor_codes[0].number"));
  EXPECT_TRUE(begins(refused({function('M', 100000000, &host)}), "vendor_codes[0].number"));
  EXPECT_TRUE(begins(refused({program('M', 500, 0, NC_CALL_SUB)}), "vendor_codes[0].function"));
  EXPECT_TRUE(begins(refused({program('M', 500, 100000000, NC_CALL_SUB)}), "vendor_codes[0].program"));
  EXPECT_TRUE(begins(refused({program('M', 500, 1, static_cast<nc_call_type>(4))}), "vendor_codes[0].call"));
  nc_vendor_code no_type = function('M', 500, &host);
  no_type.call = 4;
  EXPECT_TRUE(begins(refused({no_type}), "vendor_codes[0].call must be an nc_call_type")) << "also beside a function, where it means nothing";
  EXPECT_TRUE(begins(refused({program('M', 500, 1, NC_CALL_SUB)}, NC_DIALECT_DGSHAPE), "vendor_codes[0].program"));
  nc_vendor_code both = function('M', 500, &host);
  both.program = 1;
  EXPECT_TRUE(begins(refused({both}), "vendor_codes[0].program"));
  std::vector<nc_vendor_code> many;
  for (uint32_t i = 0; i <= NC_MAX_VENDOR_CODES; ++i) many.push_back(function('M', 500 + i, &host));
  EXPECT_TRUE(begins(refused(many), "vendor_code_count"));
  many.pop_back();
  EXPECT_EQ(refused(many), "");
}

TEST(VendorCodes, TablesOfAnotherSizeOrNone) {
  Host host;
  nc_config config;
  nc_config_init(&config);
  config.vendor_code_count = 1;
  nc_config_fault fault;
  EXPECT_EQ(nc_config_check(&config, &fault), NC_E_ARGUMENT);
  EXPECT_STREQ(fault.field, "vendor_codes");
  nc_vendor_code code = function('M', 500, &host);
  config.vendor_codes = &code;
  for (const uint32_t size : {1u, 3u, 0x10001u}) {
    code.struct_size = size;
    EXPECT_EQ(nc_config_check(&config, &fault), NC_E_ARGUMENT) << size;
    EXPECT_STREQ(fault.field, "vendor_codes[0].struct_size");
  }
  code.struct_size = 0;  // only cleared: the struct of the first version
  EXPECT_EQ(nc_config_check(&config, &fault), NC_OK);
  struct Newer {
    nc_vendor_code known{};
    uint64_t later = 0;
  } newer[2];
  for (Newer& row : newer) row.known = function('M', 500 + static_cast<uint32_t>(&row - newer), &host), row.known.struct_size = sizeof(Newer);
  config.vendor_codes = &newer[0].known;
  config.vendor_code_count = 2;
  EXPECT_EQ(nc_config_check(&config, &fault), NC_OK);
  Bench bench(NC_DIALECT_M700, [&](nc_config& c) { c.vendor_codes = config.vendor_codes, c.vendor_code_count = 2; });
  newer[0].known.number = newer[1].known.number = 700;  // the control has copies
  EXPECT_EQ(bench.run("M501\nM500\nM30").alarm, "");
  EXPECT_EQ(host.calls, (Calls{"M501 line 1 at 0:", "M500 line 2 at 0:"}));
  newer[1].later = 1;
  EXPECT_EQ(nc_config_check(&config, &fault), NC_E_ARGUMENT);
  EXPECT_STREQ(fault.field, "vendor_codes[1].struct_size");
  newer[1].later = 0;
  newer[1].known.struct_size = sizeof(nc_vendor_code);
  EXPECT_EQ(nc_config_check(&config, &fault), NC_E_ARGUMENT) << "rows of one table have one size";
}

// ---- alarm texts ----------------------------------------------------------------------------------------------------------------

bool german(void* user, const char* code, char* text, size_t size) {
  ++*static_cast<int*>(user);
  const std::string key = code;
  if (key == "P33") std::snprintf(text, size, "Formatfehler");
  if (key == "NC_E_STATE") std::snprintf(text, size, "Das geht jetzt nicht.");
  if (key == "P71") {  // a text without end, in a language whose characters have two bytes
    for (size_t i = 0; i + 1 < size; i += 2) std::memcpy(text + i, "\xc3\xbc", 2);
    text[size - 1] = 'x';
  }
  return key == "P33" || key == "NC_E_STATE" || key == "P71";
}

TEST(AlarmTexts, AreThoseOfTheHostWhereItHasOne) {
  int asked = 0;
  Bench bench(NC_DIALECT_M700, [&](nc_config& c) { c.alarm_text = german, c.alarm_text_user = &asked; });
  Outcome run = bench.run("G1 X1. F100 X=\nM30");
  EXPECT_EQ(run.alarm, "P33");
  EXPECT_EQ(run.alarm_message, "Formatfehler");
  EXPECT_EQ(asked, 1);
  run = bench.run("G1 X1.\nM30");
  EXPECT_EQ(run.alarm, "P62");
  EXPECT_EQ(run.alarm_message, "No F command") << "the host has none: the library's own stays";
  run = bench.run("G2 X10. R1. F100\nM30");
  EXPECT_EQ(run.alarm, "P71");
  std::string whole;
  for (unsigned i = 0; i < 31; ++i) whole += "\xc3\xbc";
  EXPECT_EQ(run.alarm_message, whole) << "63 bytes have room for 31 of them";
  char text[NC_MAX_TEXT];
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P33", text, sizeof text), NC_OK);
  EXPECT_STREQ(text, "Formatfehler");
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P62", text, sizeof text), NC_OK);
  EXPECT_STREQ(text, "No F command");
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P62", text, 4), NC_OK);
  EXPECT_STREQ(text, "No ");
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P99999", text, sizeof text), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_status_text_get(bench.control(), NC_E_STATE, text, sizeof text), NC_OK);
  EXPECT_STREQ(text, "Das geht jetzt nicht.");
  EXPECT_EQ(nc_status_text_get(bench.control(), NC_E_READ, text, sizeof text), NC_OK);
  EXPECT_STREQ(text, nc_status_text(NC_E_READ));
  EXPECT_EQ(nc_status_text_get(bench.control(), static_cast<nc_status>(1000), text, sizeof text), NC_OK);
  EXPECT_STREQ(text, nc_status_text(static_cast<nc_status>(1000)));
}

TEST(AlarmTexts, WithoutAHost) {
  Bench bench;
  char text[NC_MAX_TEXT] = "kept";
  EXPECT_EQ(nc_alarm_text_get(nullptr, "P33", text, sizeof text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_text_get(bench.control(), nullptr, text, sizeof text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P33", nullptr, sizeof text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P33", text, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_status_text_get(nullptr, NC_OK, text, sizeof text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_status_text_get(bench.control(), NC_OK, nullptr, sizeof text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_status_text_get(bench.control(), NC_OK, text, 0), NC_E_ARGUMENT);
  EXPECT_STREQ(text, "kept");
  EXPECT_EQ(nc_alarm_text_get(bench.control(), "P33", text, sizeof text), NC_OK);
  EXPECT_STREQ(text, "Format error");
}

}  // namespace
}  // namespace nc::test
