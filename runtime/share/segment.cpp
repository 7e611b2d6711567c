// SPDX-License-Identifier: Apache-2.0
// Creation and opening of the shared-memory segment. See segment.hpp.
#include "runtime/share/segment.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <new>

#include "runtime/services/system_error.hpp"
#include "runtime/share/door.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

std::uint64_t fnv(const void* data, std::size_t size, std::uint64_t hash) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  return hash;
}

using services::system_error;

// What is wrong with an existing segment of this size, "" = nothing.
std::string fault_of(const Segment& segment, std::uint64_t size) {
  const Identity& identity = segment.identity;
  // The memory begins as zeros, and the owner fills it and sets `life` last.
  const bool making = segment.life.load(std::memory_order_acquire) == static_cast<std::uint32_t>(Life::kMaking);
  if (identity.magic == 0 && making) return "is not complete yet";
  if (identity.magic != kMagic) return "is not a segment of ncrtd";
  if (identity.layout_version != kLayoutVersion)
    return "has layout version " + std::to_string(identity.layout_version) + ", this program reads version " +
           std::to_string(kLayoutVersion) + ": use programs of one release";
  if (identity.layout_hash != layout_hash()) return "was laid out by another build: use programs of one release";
  if (identity.size != sizeof(Segment) || size < sizeof(Segment))
    return "is too short (" + std::to_string(size) + " of " + std::to_string(sizeof(Segment)) + " bytes)";
  if (making) return "is not complete yet";
  if (segment.check != check_sum(segment)) return "is damaged (check sum)";
  const MachineBlock& machine = segment.machine;
  bool whole = machine.system_count >= 1 && machine.system_count <= NC_MAX_SYSTEMS &&
               machine.point_count <= hal::kMaxPoints && is_ended(machine.machine) && is_ended(machine.share) &&
               is_ended(machine.version);
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
    whole = whole && machine.axis_count[s] <= NC_MAX_AXES;
    for (const AxisRow& axis : machine.axis[s]) whole = whole && is_ended(axis.name);
  }
  whole = whole && machine.signal_count <= kMaxSignals;
  for (const PointRow& point : machine.point) whole = whole && is_ended(point.name) && is_ended(point.meaning);
  for (const SignalText& signal : machine.signal)
    whole = whole && is_ended(signal.name) && is_ended(signal.meaning) && is_ended(signal.timing) && signal.type <= 2;
  return whole ? "" : "is damaged (its description of the machine makes no sense)";
}

bool entry_is_sound(const Entry& entry) {
  return is_ended(entry.code) && is_ended(entry.axis) && is_ended(entry.text) && entry.system < NC_MAX_SYSTEMS;
}

bool system_is_sound(const SystemStatus& system) {
  return system.axis_count <= NC_MAX_AXES && is_ended(system.state_text) && is_ended(system.modal) &&
         is_ended(system.program) && is_ended(system.file) && is_ended(system.block) && is_ended(system.refusal_text) &&
         is_ended(system.message);
}

bool status_is_sound(const StatusBlock& block, unsigned systems) {
  if (block.system_count != systems || block.alarm_count > kAlarms) return false;
  for (unsigned i = 0; i < block.alarm_count; ++i)
    if (!entry_is_sound(block.alarm[i])) return false;
  if (block.forced_count > kForced) return false;
  for (unsigned i = 0; i < block.forced_count; ++i)
    if (!is_ended(block.forced[i].device)) return false;
  for (unsigned s = 0; s < systems; ++s)
    if (!system_is_sound(block.system[s])) return false;
  return true;
}

const char* const kTorn = "the writer stopped in the middle of a value";
const char* const kNonsense = "the segment holds values that make no sense: someone else writes there";

}  // namespace

std::string share_name(std::string_view machine) {
  std::string name;
  for (const char c : machine) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (letter) name += c;
    else if (c >= 'A' && c <= 'Z') name += static_cast<char>(c - 'A' + 'a');
    else if (!name.empty() && name.back() != '-') name += '-';
    if (name.size() == 48) break;
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "machine" : name;
}

std::int64_t wall_ns() {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

std::string segment_path(const std::string& name) {
  return "nc-" + share_name(name);
}

std::uint64_t check_sum(const Segment& segment) {
  const std::uint64_t hash = fnv(&segment.identity, sizeof segment.identity, 14695981039346656037u);
  return fnv(&segment.machine, sizeof segment.machine, hash);
}

std::uint64_t process_start(pid_t pid) {
  std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const std::size_t name_end = text.rfind(')');  // the name may hold blanks and brackets
  if (name_end == std::string::npos || name_end + 2 >= text.size()) return 0;
  if (text[name_end + 2] == 'Z' || text[name_end + 2] == 'X') return 0;
  std::size_t at = name_end + 1;
  for (unsigned field = 2; field < 21 && at != std::string::npos; ++field) at = text.find(' ', at + 1);
  return at == std::string::npos ? 0 : std::strtoull(text.c_str() + at, nullptr, 10);
}

// ---- owner ----

bool SegmentOwner::create(const std::string& name, bool group, bool commands, const MachineBlock& machine,
                          std::string* error) {
  const std::string path = segment_path(name);
  memory_ = make_sealed_memory(path, sizeof(Segment), error);
  if (memory_ < 0) return false;
  void* memory = mmap(nullptr, sizeof(Segment), PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
  if (memory == MAP_FAILED) {
    *error = system_error("shared memory " + path + " cannot be mapped");
    remove();
    return false;
  }
  segment_ = new (memory) Segment;  // the memory is all zeros: rings empty, sequences 0
  segment_->machine = machine;
  segment_->identity = {kMagic, kLayoutVersion, layout_hash(), sizeof(Segment), getpid(), commands ? 1u : 0u,
                        process_start(getpid()), wall_ns()};
  segment_->check = check_sum(*segment_);
  bool in_use = false;
  if (door_.open(path, memory_, group, &in_use, error)) return true;
  if (in_use)
    *error = "shared memory " + path + " belongs to a control that is running: give this one another name (--share)";
  remove();
  return false;
}

void SegmentOwner::remove() {
  door_.close();
  if (segment_ != nullptr) {
    segment_->life.store(static_cast<std::uint32_t>(Life::kEnded), std::memory_order_release);
    wake(&segment_->wake_reader);
    munmap(segment_, sizeof(Segment));
    segment_ = nullptr;
  }
  if (memory_ >= 0) ::close(memory_);
  memory_ = -1;
}

// ---- reader ----

bool SegmentReader::open(const std::string& name, std::string* error) {
  close();
  const std::string path = segment_path(name);
  int descriptor = -1;
  std::string why;
  switch (fetch_memory(path, &descriptor, &why)) {
    case Knock::kGiven:
      break;
    case Knock::kNobody:
      *error = "there is no control named \"" + share_name(name) + "\" that shows itself";
      return false;
    case Knock::kRefused:
      *error = "shared memory " + path + " " + why;
      return false;
  }
  struct stat status {};
  void* memory = MAP_FAILED;
  std::string fault;
  if (fstat(descriptor, &status) != 0) fault = std::strerror(errno);
  else if (status.st_size == 0) fault = "is not complete yet";
  else if (static_cast<std::uint64_t>(status.st_size) < sizeof(Identity)) fault = "is too short for a segment of ncrtd";
  // Reading a page beyond the end of the memory would be a bus error, so the size is checked before anything is read.
  else if (static_cast<std::uint64_t>(status.st_size) < sizeof(Segment)) {
    Identity identity{};
    const ssize_t got = pread(descriptor, &identity, sizeof identity, 0);
    if (got != sizeof identity || identity.magic != kMagic) fault = "is not a segment of ncrtd";
    else if (identity.layout_version != kLayoutVersion)
      fault = "has layout version " + std::to_string(identity.layout_version) + ", this program reads version " +
              std::to_string(kLayoutVersion) + ": use programs of one release";
    else
      fault = "is too short (" + std::to_string(status.st_size) + " of " + std::to_string(sizeof(Segment)) + " bytes)";
  } else {
    memory = mmap(nullptr, sizeof(Segment), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (memory == MAP_FAILED) fault = std::string("cannot be mapped: ") + std::strerror(errno);
    else fault = fault_of(*static_cast<Segment*>(memory), static_cast<std::uint64_t>(status.st_size));
  }
  ::close(descriptor);
  if (fault.empty()) {
    segment_ = static_cast<Segment*>(memory);
    return true;
  }
  if (memory != MAP_FAILED) munmap(memory, sizeof(Segment));
  *error = "shared memory " + path + " " + fault;
  return false;
}

void SegmentReader::close() {
  if (segment_ == nullptr) return;
  release_commands();
  munmap(segment_, sizeof(Segment));
  segment_ = nullptr;
}

bool SegmentReader::status(StatusBlock* block, std::string* error) const {
  if (!segment_->status.load(block)) {
    *error = kTorn;
    return false;
  }
  if (status_is_sound(*block, segment_->machine.system_count)) return true;
  *block = {};  // so that the refused contents cannot be used
  *error = kNonsense;
  return false;
}

bool SegmentReader::history(HistoryBlock* block, std::uint64_t* sequence, std::string* error) const {
  if (!segment_->history.load(block, sequence)) {
    *error = kTorn;
    return false;
  }
  const std::uint64_t filled = block->last_sequence < kHistory ? block->last_sequence : kHistory;
  bool sound = true;
  for (std::uint64_t i = 0; i < filled; ++i) {
    const std::uint64_t wanted = block->last_sequence - i;
    const Entry& entry = block->entry[(wanted - 1) % kHistory];
    sound = sound && entry.sequence == wanted && entry_is_sound(entry);
  }
  if (sound) return true;
  *error = kNonsense;
  return false;
}

bool SegmentReader::points(PointsBlock* block, std::string* error) const {
  if (!segment_->points.load(block)) {
    *error = kTorn;
    return false;
  }
  if (block->count <= hal::kMaxPoints) return true;
  *error = kNonsense;
  return false;
}

bool SegmentReader::signals(SignalsBlock* block, std::string* error) const {
  if (!segment_->signals.load(block)) {
    *error = kTorn;
    return false;
  }
  if (block->count <= segment_->machine.signal_count) return true;
  *error = kNonsense;
  return false;
}

bool SegmentReader::owner_gone() const {
  if (segment_->life.load(std::memory_order_acquire) == static_cast<std::uint32_t>(Life::kEnded)) return true;
  return process_start(segment_->identity.owner_pid) != segment_->identity.owner_start;
}

bool SegmentReader::claim_commands(std::string* error) {
  if (segment_->identity.commands == 0) {
    *error = "ncrtd takes no commands (its option --commands, or [share] commands)";
    return false;
  }
  const std::int32_t mine = getpid();
  std::int32_t holder = segment_->command_pid.load();
  for (;;) {
    if (holder == mine) return claimed_ = true;
    if (holder != 0 && process_start(holder) != 0) {
      *error = "process " + std::to_string(holder) + " already gives the commands to this control";
      return false;
    }
    if (segment_->command_pid.compare_exchange_strong(holder, mine)) return claimed_ = true;
  }
}

void SegmentReader::release_commands() {
  if (segment_ == nullptr || !claimed_) return;
  claimed_ = false;
  std::int32_t mine = getpid();
  segment_->command_pid.compare_exchange_strong(mine, 0);
}

void SegmentReader::take_claim_of(SegmentReader* other) {
  claimed_ = other->claimed_;
  other->claimed_ = false;
}

// ---- futex ----

void wake(std::atomic<std::uint32_t>* word) {
  word->fetch_add(1, std::memory_order_release);
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(word), FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

void wait_for_change(std::atomic<std::uint32_t>* word, std::uint32_t seen, std::int64_t timeout_ns) {
  if (timeout_ns <= 0) return;
  const timespec timeout{timeout_ns / 1'000'000'000, timeout_ns % 1'000'000'000};
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(word), FUTEX_WAIT, seen, &timeout, nullptr, 0);
}

}  // namespace nc::rt::share
