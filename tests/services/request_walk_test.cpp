// SPDX-License-Identifier: Apache-2.0
// A walk through each member of each service with all that it must not be: every one is refused, and the refusal names the member.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "runtime/services/call.hpp"
#include "services/service_arguments.hpp"

namespace nc::rt::services {
namespace {

using test::arguments_of;

// "" = taken, else the sentence of the refusal.
std::string refusal_of(const std::string& frame) {
  Call call;
  Outcome outcome;
  if (decode_call(frame, &call, &outcome)) return "";
  EXPECT_EQ(outcome.why, Refused::kMalformed) << frame.substr(0, 200);
  EXPECT_FALSE(outcome.text.empty());
  return outcome.text;
}

std::string frame_with(const ServiceRow& row, const Json& args) { return Json{{"id", 1}, {"service", row.name}, {"args", args}}.dump(); }

// Texts in JSON that no member of this kind may be.
std::vector<std::string> wrong_for(const FieldInfo& field) {
  std::vector<std::string> wrong{"null", "{}", "{\"a\":1}", "[[]]", "[null]", "1e999", "-1e999", "\"M\xfcller\"", "\"\x93\xfa\x96\x7b\"", "\"\xed\xa0\x80\""};
  const auto add = [&](std::initializer_list<const char*> more) { wrong.insert(wrong.end(), more.begin(), more.end()); };
  switch (field.kind) {
    case Kind::kWhole: add({"0.5", "1.0000001"}); [[fallthrough]];
    case Kind::kNumber:
      add({"\"1\"", "true", "[]", "1e308", "-1e308", "18446744073709551616"});
      wrong.push_back(Json(field.most * 2 + 1).dump());
      wrong.push_back(Json(field.least - 1 - std::abs(field.least)).dump());
      break;
    case Kind::kFlag: add({"0", "1", "\"true\"", "[]", "2.5"}); break;
    case Kind::kText:
    case Kind::kName:
      add({"1", "true", "[]", "\"a\\u0000b\"", "\"\\u0007\""});
      wrong.push_back("\"" + std::string(static_cast<std::size_t>(field.most) + 1, 'x') + "\"");
      if (field.least > 0) wrong.push_back("\"" + std::string(static_cast<std::size_t>(field.least) - 1, 'x') + "\"");
      if (field.kind == Kind::kName) add({"\"../x\"", "\"/etc/passwd\"", "\".x\"", "\"a\\\\b\"", "\"..\""});
      break;
    case Kind::kData: add({"1", "true", "[]", "\"A\"", "\"====\"", "\"A\\u0000==\""}); break;
    case Kind::kList: add({"1", "true", "\"X\"", "[1]", "[\"\"]", "[\"a\\u0000\"]", "[true,\"X\"]"}); break;
  }
  return wrong;
}

TEST(RequestWalk, EachMemberOfEachServiceIsHeldToItsRow) {
  unsigned refused = 0;
  for (const ServiceRow& row : service_table()) {
    SCOPED_TRACE(row.name);
    const Json good = arguments_of(row);
    EXPECT_EQ(refusal_of(frame_with(row, good)), "");
    Json more = good;
    more["nothing_of_this"] = 1;
    EXPECT_NE(refusal_of(frame_with(row, more)).find("nothing_of_this"), std::string::npos);
    for (const Wanted& wanted : row.request) {
      const FieldInfo& field = row_of(wanted.field);
      SCOPED_TRACE(field.name);
      if (wanted.required) {
        Json less = good;
        less.erase(field.name);
        EXPECT_NE(refusal_of(frame_with(row, less)).find(field.name), std::string::npos);
      }
      for (const std::string& wrong : wrong_for(field)) {
        Json others = good;
        others.erase(field.name);
        std::string args = others.dump();
        args = "{\"" + std::string(field.name) + "\":" + wrong + (others.empty() ? "" : ",") + args.substr(1);
        const std::string text = refusal_of("{\"id\":1,\"service\":\"" + std::string(row.name) + "\",\"args\":" + args + "}");
        EXPECT_NE(text.find(field.name), std::string::npos) << wrong.substr(0, 60) << ": " << (text.empty() ? "taken" : text);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 1500u);
}

// Requests in which anything is replaced by anything: whatever is taken fulfils the rows, and nothing else happens than a refusal with a sentence.
TEST(RequestWalk, RandomRequestsAreTakenOnlyAsTheRowsSay) {
  const char* of_environment = std::getenv("NC_SEEDS");
  const unsigned seeds = of_environment == nullptr ? 20000 : static_cast<unsigned>(std::atoi(of_environment));
  unsigned taken = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto any = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random); };
    const auto value = [&](auto&& self, unsigned depth) -> Json {
      switch (any(depth > 2 ? 7 : 9)) {
        case 0: return nullptr;
        case 1: return any(1) == 0;
        case 2: return static_cast<std::int64_t>(random()) - 2'000'000'000;
        case 3: return std::ldexp(static_cast<double>(random()), static_cast<int>(any(1900)) - 950);
        case 4: return std::string(any(80), static_cast<char>('!' + any(90)));
        case 5: return std::string("a\0b", 3);
        case 6: return Json({"X", "Y"});
        case 7: return row_of(static_cast<Field>(any(kFields - 1))).name;
        case 8: return Json{{"a", self(self, depth + 1)}};
        default: return Json::array({self(self, depth + 1), self(self, depth + 1)});
      }
    };
    const ServiceRow& row = service_table()[any(kServiceRows - 1)];
    Json args = arguments_of(row);
    for (std::size_t n = any(3); n > 0; --n) {
      const std::string name = !row.request.empty() && any(4) != 0 ? row_of(row.request[any(row.request.size() - 1)].field).name : row_of(static_cast<Field>(any(kFields - 1))).name;
      if (any(3) == 0) args.erase(name);
      else args[name] = value(value, 0);
    }
    Json request = {{"id", 1}, {"service", row.name}, {"args", args}};
    if (any(20) == 0) request[any(1) == 0 ? "args" : "id"] = value(value, 0);
    std::string frame = request.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t n = any(9) == 0 ? 1 + any(3) : 0; n > 0; --n) frame[any(frame.size() - 1)] = static_cast<char>(random());
    Call call;
    Outcome outcome;
    if (!decode_call(frame, &call, &outcome)) {
      EXPECT_FALSE(outcome.text.empty());
      EXPECT_TRUE(outcome.why == Refused::kMalformed || outcome.why == Refused::kUnknownService);
      continue;
    }
    ++taken;
    for (const Wanted& wanted : call.row->request) {
      const FieldInfo& field = row_of(wanted.field);
      EXPECT_TRUE(call.has(wanted.field) || !wanted.required) << field.name;
      if (!call.has(wanted.field)) continue;
      const double number = call.value(wanted.field);
      if (field.kind == Kind::kNumber || field.kind == Kind::kWhole) {
        EXPECT_TRUE(number >= field.least && number <= field.most) << field.name;
      }
      if (field.kind == Kind::kWhole) {
        EXPECT_EQ(number, std::floor(number)) << field.name;
      }
      if (field.kind == Kind::kText || field.kind == Kind::kName) {
        EXPECT_EQ(call.words(wanted.field).find('\0'), std::string::npos) << field.name;
      }
      if (field.kind == Kind::kName) {
        EXPECT_TRUE(is_program_name(call.words(wanted.field)));
      }
    }
  }
  EXPECT_GT(taken, seeds / 10);
}

}  // namespace
}  // namespace nc::rt::services
