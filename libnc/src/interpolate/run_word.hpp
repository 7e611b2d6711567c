// SPDX-License-Identifier: Apache-2.0
// Says which run of a program the scan and the feeder are in. It is one word, which only the scan writes; the feeder answers with the word that it
// has acted upon. So several events that happen between two calls of the feeder can never look like another event, or like none.
//
//     word = epoch * 2 + active          epoch: how often everything that was committed has become void
//
//     state of the scan                      word     leaves it by                                        owner
//     IDLE                                   even     cycle start, once the feeder has taken this word    scan
//     RUNNING, HOLD, STOPPED                 odd      hold, block stop, cycle start: the word stays       scan
//                                                     end item: even, the same epoch, IDLE                scan
//                                                     reset, alarm or fault, at rest: even, next epoch    scan
//     ALARM of the program (alarm item)      odd      end item behind the alarm: even, the same epoch     scan
//     ALARM                                  even     reset: even, next epoch, IDLE                       scan
//
//     the feeder finds                       and does
//     odd, another word than the one taken   begins the selected program at its head, where the machine stands
//     even, the same epoch                   nothing: it has committed the end item
//     even, another epoch                    takes back what was read beyond the last block that was executed, unless that was the end;
//                                            interpreter as after reset
//
// The feeder reads the word in nc_feed(), and before every call that is refused while a program runs, so that no such call has to wait for nc_feed().
// A start waits until the feeder has taken the word that it changes: else the feeder could miss what happened between two starts.
// A record carries the epoch in which it was made; the scan throws records of another epoch away.
//
// A reset comes to IDLE when (1) the axes have come to rest, (2) a truncation is withdrawn, or done by the feeder in the call that it is in
// (interpolate/truncation.hpp), (3) a rereading that was asked for is done, by the next nc_feed() whatever its state is.
//
// After 2^31 - 1 the epoch begins again at 0. That does no harm, because it is compared only with records that are in the ring.
#pragma once

#include <cstdint>

namespace nc {

class RunWord {
 public:
  RunWord() = default;
  explicit RunWord(uint32_t word) : word_(word) {}
  uint32_t word() const { return word_; }
  uint32_t epoch() const { return word_ >> 1; }
  bool active() const { return (word_ & 1) != 0; }
  void start() { word_ |= 1u; }
  void end() { word_ &= ~1u; }
  void give_up() { word_ = (word_ | 1u) + 1u; }

 private:
  uint32_t word_ = 0;
};

}  // namespace nc
