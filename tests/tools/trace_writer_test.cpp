// SPDX-License-Identifier: Apache-2.0
// Expected lines of a trace, literally: whoever changes them changes the documented format (docs/trace.md).
#include "tools/lib/trace_writer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "fake_items.hpp"

namespace nc::tools {
namespace {

constexpr nc_source kSource = {12, 1000, 0, 2, 0};

template <typename Write>
std::string lines(Write write) {
  ScratchFile scratch;
  OutputFile out(scratch.descriptor());
  TraceWriter writer(&out, xyz());
  write(writer);
  EXPECT_TRUE(out.flush());
  return scratch.content();
}

nc_move straight(nc_move_kind kind) {
  nc_move m = {};
  m.kind = static_cast<uint8_t>(kind);
  m.plane = NC_PLANE_NONE;
  m.work = {{1, -2.5, 9.99999999999}};
  m.machine = {{101, -0.0, 3}};
  m.feed_mm_min = 600;
  return m;
}

TEST(TraceWriter, Moves) {
  EXPECT_EQ(lines([](TraceWriter& w) { w.move(kSource, straight(NC_MOVE_LINE)); }),
            "{\"t\":\"move\",\"sys\":1,\"line\":12,\"prog\":1000,\"depth\":2,\"kind\":\"line\","
            "\"work\":{\"X\":1,\"Y\":-2.5,\"Z\":10},\"machine\":{\"X\":101,\"Y\":0,\"Z\":3},\"feed\":600}\n");
  EXPECT_EQ(
      lines([](TraceWriter& w) {
        w.move({1, 0, 0, 0, 0}, straight(NC_MOVE_RAPID));
      }),
      "{\"t\":\"move\",\"sys\":1,\"line\":1,\"prog\":0,\"depth\":0,\"kind\":\"rapid\","
      "\"work\":{\"X\":1,\"Y\":-2.5,\"Z\":10},\"machine\":{\"X\":101,\"Y\":0,\"Z\":3},\"feed\":null}\n");
  EXPECT_EQ(lines([](TraceWriter& w) {
              nc_move m = straight(NC_MOVE_TAP);
              m.feed_mm_rev = 1.25;
              w.move({1, 0, 0, 0, 0}, m);
            }),
            "{\"t\":\"move\",\"sys\":1,\"line\":1,\"prog\":0,\"depth\":0,\"kind\":\"tap\","
            "\"work\":{\"X\":1,\"Y\":-2.5,\"Z\":10},\"machine\":{\"X\":101,\"Y\":0,\"Z\":3},\"feed\":null,"
            "\"feed_rev\":1.25}\n");
}

TEST(TraceWriter, CircularMoves) {
  nc_move m = straight(NC_MOVE_HELIX);
  m.plane = NC_PLANE_ZX;
  m.center_axes = 2;
  m.plane_axis[0] = 2;
  m.plane_axis[1] = 0;
  m.ccw = true;
  m.center[0] = 5;
  m.center[1] = 6;
  m.machine_center[0] = 7;
  m.machine_center[1] = -8.5;
  m.turns = 3;
  m.radius = 12.5;
  const std::string start =
      "{\"t\":\"move\",\"sys\":1,\"line\":12,\"prog\":1000,\"depth\":2,\"kind\":\"helix\","
      "\"work\":{\"X\":1,\"Y\":-2.5,\"Z\":10},\"machine\":{\"X\":101,\"Y\":0,\"Z\":3},\"feed\":600,";
  const std::string rest =
      "\"dir\":\"ccw\",\"center\":{\"Z\":5,\"X\":6},\"machine_center\":{\"Z\":7,\"X\":-8.5},\"turns\":3,"
      "\"radius\":12.5}\n";
  EXPECT_EQ(lines([&](TraceWriter& w) { w.move(kSource, m); }), start + "\"plane\":\"ZX\"," + rest);
  m.plane = NC_PLANE_NONE;  // an arc in no plane of the axes
  EXPECT_EQ(lines([&](TraceWriter& w) { w.move(kSource, m); }), start + rest);
}

TEST(TraceWriter, TheOtherEvents) {
  const std::string head = "\"sys\":1,\"line\":12,\"prog\":1000,\"depth\":2,";
  EXPECT_EQ(lines([](TraceWriter& w) {
              w.block(kSource, {{1, 2, 3}}, {{4, 5, 6}});
            }),
            "{\"t\":\"block\"," + head +
                "\"work\":{\"X\":1,\"Y\":2,\"Z\":3},\"machine\":{\"X\":4,\"Y\":5,\"Z\":6}}\n");
  EXPECT_EQ(lines([](TraceWriter& w) { w.aux(kSource, 'S', 1500.5); }),
            "{\"t\":\"aux\"," + head + "\"code\":\"S\",\"value\":1500.5}\n");
  EXPECT_EQ(lines([](TraceWriter& w) { w.dwell(kSource, false, 1.5); }),
            "{\"t\":\"dwell\"," + head + "\"seconds\":1.5}\n");
  EXPECT_EQ(lines([](TraceWriter& w) { w.dwell(kSource, true, 3); }),
            "{\"t\":\"dwell\"," + head + "\"revolutions\":3}\n");
  EXPECT_EQ(lines([](TraceWriter& w) { w.sync(kSource, NC_SYNC_INPUT | NC_SYNC_CLOCK); }),
            "{\"t\":\"sync\"," + head + "\"what\":\"input+clock\"}\n");
  EXPECT_EQ(lines([](TraceWriter& w) { w.message(kSource, 3, nc_text{"X=\"1\"\t\\", 0}); }),
            "{\"t\":\"message\"," + head + "\"port\":3,\"text\":\"X=\\\"1\\\"\\u0009\\\\\"}\n");
  nc_alarm alarm = {};
  std::snprintf(alarm.code, sizeof alarm.code, "P33");
  std::snprintf(alarm.message, sizeof alarm.message, "Format error");
  std::snprintf(alarm.detail.s, sizeof alarm.detail.s, "N is not followed by a number");
  alarm.source = kSource;
  EXPECT_EQ(
      lines([&](TraceWriter& w) { w.alarm(alarm); }),
      "{\"t\":\"alarm\"," + head +
          "\"code\":\"P33\",\"message\":\"Format error\",\"detail\":\"N is not followed by a number\"}\n");
}

TEST(TraceWriter, EndHasVariablesAndModalCodes) {
  FakeItems items;
  items.common = {{100, 1.5}, {101, -0.0}, {999, 1e-12}};
  items.codes = {"G01", "G54.1"};
  EXPECT_EQ(lines([&](TraceWriter& w) {
              w.end({9, 0, 0, 0, 0}, true, {{1, 2, 3}}, {{4, 5, 6}}, 0, &items);
            }),
            "{\"t\":\"end\",\"sys\":1,\"line\":9,\"prog\":0,\"depth\":0,\"ok\":true,\"work\":{\"X\":1,\"Y\":"
            "2,\"Z\":3},"
            "\"machine\":{\"X\":4,\"Y\":5,\"Z\":6},\"vars\":{\"100\":1.5,\"101\":0,\"999\":1e-12},"
            "\"modal\":[\"G01\",\"G54.1\"],\"seconds\":null}\n");
}

TEST(TraceWriter, ThousandsOfVariablesFit) {
  FakeItems items;
  for (uint32_t n = 900'000; n < 907'400; ++n) items.common[n] = 1.0 / n;
  const std::string text = lines([&](TraceWriter& w) { w.end({}, false, {}, {}, 0, &items); });
  const auto parsed = nlohmann::json::parse(text);
  EXPECT_EQ(parsed["vars"].size(), 7400u);
  EXPECT_NEAR(parsed["vars"]["907399"].get<double>(), 1.0 / 907'399, 1e-20);
}

TEST(JsonEscaped, AnyBytesGiveValidJson) {
  EXPECT_EQ(json_escaped("\xC3\xA4"), "\xC3\xA4");                   // ä in UTF-8 stays
  EXPECT_EQ(json_escaped("\xE4"), "\\u00e4");                        // ä in Latin-1
  EXPECT_EQ(json_escaped("\xC0\xAF"), "\\u00c0\\u00af");             // overlong
  EXPECT_EQ(json_escaped("\xED\xA0\x80"), "\\u00ed\\u00a0\\u0080");  // surrogate
  EXPECT_EQ(json_escaped("\xE3\x81"), "\\u00e3\\u0081");             // cut off
  std::string all;
  for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
  EXPECT_NO_THROW({
    const auto parsed = nlohmann::json::parse("\"" + json_escaped(all) + "\"");
    EXPECT_TRUE(parsed.is_string());
  });
}

}  // namespace
}  // namespace nc::tools
