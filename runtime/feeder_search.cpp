// SPDX-License-Identifier: Apache-2.0
// The external search (runtime/restart/external_search.hpp): select by number, wait for the check of the program, look for the place.
#include "runtime/feeder.hpp"

namespace nc::rt {
namespace {

constexpr std::int32_t kLargestNumber = 99'999'999;  // of programs and sequence numbers, in every family

}  // namespace

void Feeder::follow_search() {
  for (unsigned s = 0; s < systems_; ++s) {
    SearchAsked asked;
    if (scan_->search(s).take(&asked)) begin_search(s, asked);
    else go_on_searching(s);
  }
}

void Feeder::answer_search(unsigned s, SearchResult result, const std::string& why) {
  search_[s] = {};
  scan_->search(s).answer(result);
  tell("external search: " + why, s);
}

// What was asked for is not there. What is selected, or was found before, is another part's, so no start begins that.
void Feeder::bar_start(unsigned s, SearchResult result, const std::string& why) {
  answer_search(s, result, why);
  if (hindrance() == Answer::kDone) restart_[s].bar_start("external search: " + why);
}

void Feeder::begin_search(unsigned s, const SearchAsked& asked) {
  search_[s] = {};
  const auto fits = [](std::int32_t number) { return number >= 0 && number <= kLargestNumber; };
  if (!fits(asked.program) || !fits(asked.sequence) || (asked.program == 0 && asked.sequence == 0))
    return bar_start(s, SearchResult::kBadNumber, "no program or sequence number is given, or one out of range");
  Answer why = seen_.mode != Mode::kAuto ? Answer::kNotInThisMode : hindrance();
  if (why == Answer::kDone && asked.program == 0 && (!system_[s].selected || system_[s].mdi)) why = Answer::kNoProgram;
  if (why != Answer::kDone) return bar_start(s, SearchResult::kRefused, answer_text(why));
  if (asked.program != 0) {
    const std::string name = "O" + std::to_string(asked.program);
    Command command = of_machine(CommandKind::kSelectProgram, s);
    std::string said;
    if (!load(name, &command.number, &said)) return bar_start(s, SearchResult::kNoProgram, said);
    if (why = select(command); why != Answer::kDone) return bar_start(s, SearchResult::kRefused, answer_text(why));
  }
  search_[s] = {Search::kChecks, system_[s].file, static_cast<std::uint32_t>(asked.sequence)};
  go_on_searching(s);
}

// The program has to pass its check before a place in it may be looked for, and before a start begins it.
void Feeder::go_on_searching(unsigned s) {
  const Search now = search_[s];
  if (now.step == Search::kNothing) return;
  Answer why = seen_.mode != Mode::kAuto ? Answer::kNotInThisMode : hindrance();
  if (now.step == Search::kLooks) {
    const RestartStatus& place = restart_[s].status();
    if (place.phase == RestartPhase::kFound) answer_search(s, SearchResult::kFound, "sequence number " + std::to_string(now.sequence) + " of " + nc_->program_name(now.file) + " is found");
    else if (place.phase != RestartPhase::kSearching) answer_search(s, why == Answer::kDone && place.phase == RestartPhase::kLost ? SearchResult::kNoPlace : SearchResult::kRefused, place.text);
    return;
  }
  const System& head = system_[s];
  if (why == Answer::kDone && (!head.selected || head.mdi || head.file != now.file)) why = Answer::kTakenBack;
  if (why != Answer::kDone) return answer_search(s, SearchResult::kRefused, why == Answer::kTakenBack ? "another program was selected" : answer_text(why));
  if (gate_ != nullptr && !gate_->may_begin(s, now.file)) {
    if (!gate_->waits(s)) answer_search(s, SearchResult::kNotChecked, gate_->remark(s));
    return;
  }
  if (now.sequence == 0) return answer_search(s, SearchResult::kFound, nc_->program_name(now.file) + " is selected");
  why = look_for(of_machine(CommandKind::kFindRestart, s), {RestartBy::kSequence, now.sequence, 0, ""});
  if (why != Answer::kDone) return answer_search(s, SearchResult::kNoPlace, answer_text(why));
  search_[s].step = Search::kLooks;
}

}  // namespace nc::rt
