// SPDX-License-Identifier: Apache-2.0
// Requests as bytes: what is taken, and what is refused with which name. Frames, base64, names of programs.
#include "runtime/services/call.hpp"

#include <gtest/gtest.h>

#include <set>

#include "runtime/programs/encoding.hpp"
#include "runtime/services/frames.hpp"

namespace nc::rt::services {
namespace {

struct Decoded {
  bool good = false;
  Call call;
  Outcome outcome;
};
Decoded decode(const std::string& text) {
  Decoded result;
  result.good = decode_call(text, &result.call, &result.outcome);
  return result;
}

TEST(ServiceCall, TakesWhatTheTableSays) {
  const Decoded jog = decode(R"({"id": 7, "service": "jog", "args": {"axis": "X", "velocity": -12.5, "system": 2}})");
  ASSERT_TRUE(jog.good) << jog.outcome.text;
  EXPECT_EQ(jog.call.id, 7u);
  EXPECT_EQ(jog.call.row->service, Service::kJog);
  EXPECT_EQ(jog.call.words(Field::kAxis), "X");
  EXPECT_EQ(jog.call.value(Field::kVelocity), -12.5);
  EXPECT_EQ(jog.call.value(Field::kSystem), 2);
  EXPECT_FALSE(jog.call.has(Field::kLifespan));
  EXPECT_TRUE(decode(R"({"id": 0, "service": "status"})").good);
  const Decoded data = decode(R"({"id": 1, "service": "programs.data", "args": {"upload": 1, "begin": 0, "data": "AP8K"}})");
  ASSERT_TRUE(data.good) << data.outcome.text;
  EXPECT_EQ(data.call.words(Field::kData), std::string("\0\xff\n", 3));
}

TEST(ServiceCall, WhatIsWrongIsNamed) {
  const struct {
    const char* text;
    Refused why;
    const char* said;
  } cases[] = {
      {"", Refused::kMalformed, "no JSON"},
      {"[]", Refused::kMalformed, "no object"},
      {"{\"id\": 1, \"service\": \"status\"} x", Refused::kMalformed, "no JSON"},
      {R"({"service": "status"})", Refused::kMalformed, "id"},
      {R"({"id": -1, "service": "status"})", Refused::kMalformed, "id"},
      {R"({"id": 1.5, "service": "status"})", Refused::kMalformed, "id"},
      {R"({"id": 1})", Refused::kMalformed, "service"},
      {R"({"id": 1, "service": "nothing"})", Refused::kUnknownService, "no such service"},
      {R"({"id": 1, "service": "status", "more": 1})", Refused::kMalformed, "more"},
      {R"({"id": 1, "service": "status", "args": []})", Refused::kMalformed, "args"},
      {R"({"id": 1, "service": "status", "args": {"x": 1}})", Refused::kMalformed, "\"x\""},
      {R"({"id": 1, "service": "mode"})", Refused::kMalformed, "needs mode"},
      {R"({"id": 1, "service": "mode", "args": {"mode": 1}})", Refused::kMalformed, "text"},
      {R"({"id": 1, "service": "mode", "args": {"mode": "auto", "mode": "mdi"}})", Refused::kMalformed, "twice"},
      {R"({"id": 1, "service": "single", "args": {"on": 1}})", Refused::kMalformed, "true or false"},
      {R"({"id": 1, "service": "jog", "args": {"axis": "X", "velocity": 1e7}})", Refused::kMalformed, "-1000000 to 1000000"},
      {R"({"id": 1, "service": "jog", "args": {"axis": "X", "velocity": 1e999}})", Refused::kMalformed, "the request has a number that is too large: \"velocity\""},
      {R"({"id": 1, "service": "jog", "args": {"axis": "XY", "velocity": 1}})", Refused::kMalformed, "bytes"},
      {R"({"id": 1, "service": "tools.set", "args": {"number": 1.5, "length": 1}})", Refused::kMalformed, "whole"},
      {R"({"id": 1, "service": "mdi", "args": {"blocks": "G0\u0000X1"}})", Refused::kMalformed, "control characters"},
      {R"({"id": 1, "service": "select", "args": {"name": "\u0085a.nc"}})", Refused::kMalformed, "without a path"},
      {R"({"id": 1, "service": "select", "args": {"name": "a\u202ecn.b"}})", Refused::kMalformed, "without a path"},
      {R"({"id": 1, "service": "programs.data", "args": {"upload": 1, "begin": 0, "data": "A"}})", Refused::kMalformed, "base64"},
      {R"({"id": 1, "service": "status", "args": {"a": {"b": {"c": {"d": {"e": 1}}}}}})", Refused::kMalformed, "deep"},
      {"{\"id\": 1, \"service\": \"select\", \"args\": {\"name\": \"M\xfcller.nc\"}}", Refused::kMalformed, "UTF-8: \"name\" has other bytes"},         // Latin-1
      {"{\"id\": 1, \"service\": \"select\", \"args\": {\"name\": \"\x93\xfa\x96\x7b.nc\"}}", Refused::kMalformed, "UTF-8: \"name\" has other bytes"},  // Shift-JIS
      {"{\"id\": 1, \"service\": \"select\", \"args\": {\"na\xfcme\": 1}}", Refused::kMalformed, "UTF-8: \"na\xef\xbf\xbdme\" has other bytes"},
      {"{\"id\": 1, \"service\": \"select\", \"args\": {\"name\": \"\x95\x5c.nc\"}}", Refused::kMalformed, "UTF-8"},  // Shift-JIS with a backslash in it
      {R"({"id": 1, "service": "select", "args": {"name": "../x.nc"}})", Refused::kMalformed, "without a path"},
      {R"({"id": 1, "service": "select", "args": {"name": "a\u0000.nc"}})", Refused::kMalformed, "without a path"},
  };
  for (const auto& c : cases) {
    const Decoded result = decode(c.text);
    EXPECT_FALSE(result.good) << c.text;
    EXPECT_EQ(result.outcome.why, c.why) << c.text;
    EXPECT_NE(result.outcome.text.find(c.said), std::string::npos) << c.text << ": " << result.outcome.text;
  }
}

// A NUL is no end: what stands behind it would be neither read nor refused.
TEST(ServiceCall, NothingIsHiddenBehindANul) {
  const std::string good = R"({"id": 1, "service": "status"})";
  ASSERT_TRUE(decode(good).good);
  for (const std::string& behind : {std::string(1, '\0'), std::string("\0x", 2), std::string(" \0", 2), std::string("\0{\"id\": 2}", 10)}) {
    const Decoded result = decode(good + behind);
    EXPECT_FALSE(result.good);
    EXPECT_EQ(result.outcome.why, Refused::kMalformed);
    EXPECT_EQ(result.outcome.text, "the request is no JSON: it has a NUL");
  }
  EXPECT_FALSE(decode(std::string("{\"id\": 1, \0\"service\": \"status\"}", 30)).good);
}

TEST(ServiceCall, NamesOfProgramsStayInTheirFolder) {
  for (const char* good : {"part.nc", "O1000", "Fräser 2.nc", "a..b", "日本.nc"}) EXPECT_TRUE(is_program_name(good)) << good;
  for (const char* bad : {"", ".", "..", ".hidden", "/etc/passwd", "a/b", "..\\x", "a\nb", "a\x7f", "M\xfcller.nc", "\x83\x8f.nc"}) EXPECT_FALSE(is_program_name(bad)) << bad;
  EXPECT_FALSE(is_program_name(std::string_view("a\0b", 3)));
}

TEST(ServiceCall, Base64IsThatOfRfc4648) {
  const std::pair<const char*, const char*> pairs[] = {{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : pairs) {
    EXPECT_EQ(to_base64(bytes), text);
    std::string back;
    EXPECT_TRUE(from_base64(text, &back));
    EXPECT_EQ(back, bytes);
  }
  std::string back;
  for (const char* bad : {"Z", "Zg=", "Zh==", "Zm9=", "Zm9v!", "====", "Zg==Zg==", "Z g="}) EXPECT_FALSE(from_base64(bad, &back)) << bad;
}

TEST(ServiceCall, FramesComeInAnyPieces) {
  const std::string stream = frame_of("one") + frame_of("") + frame_of("three");
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    FrameReader reader;
    std::vector<std::string> texts;
    std::string text;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      reader.add(std::string_view(stream).substr(at, piece));
      while (reader.next(&text) == FrameReader::Next::kFrame) texts.push_back(text);
    }
    EXPECT_EQ(texts, (std::vector<std::string>{"one", "", "three"})) << piece;
    EXPECT_FALSE(reader.waits());
  }
  FrameReader reader;
  std::string text;
  reader.add(std::string("\0\x08\0\x01", 4));
  EXPECT_EQ(reader.next(&text), FrameReader::Next::kTooLong);
}

// Whoever looks ahead sees each frame that was not taken before, once, and takes them all in their order.
TEST(ServiceCall, FramesAreSeenAheadOnce) {
  const std::vector<std::string> all{"one", "", "three", "four", "5", "six"};
  std::string stream;
  for (const std::string& text : all) stream += frame_of(text);
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    for (std::size_t every = 1; every < 5; ++every) {
      FrameReader reader;
      std::vector<std::string> taken;
      std::size_t seen = 0, turn = 0;  // seen: of `all`, behind those that were taken when it was looked
      std::string text;
      for (std::size_t at = 0; at < stream.size(); at += piece) {
        reader.add(std::string_view(stream).substr(at, piece));
        if (turn++ % every == 0 && reader.next(&text) == FrameReader::Next::kFrame) taken.push_back(text);
        seen = std::max(seen, taken.size());
        reader.look_ahead([&](std::string_view frame) { EXPECT_EQ(frame, all.at(seen++)); });
      }
      while (reader.next(&text) == FrameReader::Next::kFrame) taken.push_back(text);
      EXPECT_EQ(taken, all) << piece << " " << every;
      EXPECT_EQ(seen, all.size());
    }
  }
}

TEST(ServiceCall, AReplyThatIsTooLongIsARefusal) {
  const Json reply = Json::parse(encode_reply(3, Outcome::done(std::string(kMostFrameBytes, 'x'))));
  EXPECT_EQ(reply["ok"], false);
  EXPECT_EQ(reply["error"], "failed");
  EXPECT_EQ(Json::parse(encode_reply(4, Outcome::done("M\xfcller")))["reply"]["text"], "M\xef\xbf\xbdller");
}

TEST(ServiceCall, RefusalsHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (unsigned i = 0; i < static_cast<unsigned>(Refused::kCount); ++i) names.insert(refused_name(static_cast<Refused>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Refused::kCount));
  EXPECT_EQ(names.count("?"), 0u);
}

// What a terminal obeys is a blank in what is shown, whole characters beside it stay.
TEST(ServiceCall, ATextForATerminalHasNothingThatItObeys) {
  EXPECT_EQ(seen_text("a\x1b[31m\x7f\t\n"), "a [31m   ");
  EXPECT_EQ(seen_text("\xc2\x9b" "31m \xc2\x80\xc2\x9f\xc2\xa0"), " 31m   \xc2\xa0");
  EXPECT_EQ(seen_text("\xe2\x80\xae" "cn.\xe2\x81\xa6\xe2\x80\x8f\xd8\x9c\xe2\x80\xa8"), " cn.    ");
  EXPECT_EQ(seen_text("\xe2\x80\xa2 \xe2\x80\xaf \xd8\x9d \xe5\x88\x87\xe5\x89\x8a \xc3\x9b"), "\xe2\x80\xa2 \xe2\x80\xaf \xd8\x9d \xe5\x88\x87\xe5\x89\x8a \xc3\x9b");
  EXPECT_EQ(seen_text("\x9b" "31m"), "\xef\xbf\xbd" "31m") << "no character";
}

}  // namespace
}  // namespace nc::rt::services
