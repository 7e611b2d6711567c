// SPDX-License-Identifier: Apache-2.0
// The body of the interpreter, which is included three times. With NC_LADDER_THREADED the code of every instruction ends with a jump to the code of
// the next one, so the processor predicts each of these jumps separately; otherwise there is one switch in a loop. With NC_LADDER_WATCHED
// the devices that are held get their value back after each instruction, and the result of logic behind it is noted. NC_RT.

#ifdef NC_LADDER_WATCHED
Outcome NC_LADDER_EXECUTE(const Code& code, DeviceImage* image, const Hold* holds, unsigned hold_count, std::uint8_t* flow) noexcept {
  const auto after = [=, first = code.units.data()](const Unit* executed, std::uint32_t result) {
    if (flow != nullptr && executed != nullptr) flow[executed - first] = static_cast<std::uint8_t>(kFlowExecuted | result);
    for (unsigned i = 0; i < hold_count; ++i) {
      const Hold& hold = holds[i];
      if (hold.type == DeviceType::kBit) image->bit[hold.index] = hold.value != 0;
      else if (hold.type == DeviceType::kWord16) image->word[hold.index] = static_cast<std::int16_t>(hold.value);
      else image->set_word32(hold.index, hold.value);
    }
  };
#define NC_LADDER_AFTER(executed) after(executed, rlo)
#else
Outcome NC_LADDER_EXECUTE(const Code& code, DeviceImage* image) noexcept {
#define NC_LADDER_AFTER(executed) (void)0
#endif
  Machine machine{
      code, code.layout, image->bit.data(), image->word.data(), code.units.data(), code.step_budget};
  machine.begin();
  std::uint8_t* const bit = machine.bit;
  std::int16_t* const word = machine.word;
  const Unit* const units = machine.units;
  const Unit* ip = units;
  std::uint32_t rlo = 0;  // 0 or 1
  struct Frame {
    const Unit* back;
    std::uint32_t rlo;
  } frames[kMaxCalls];
  unsigned depth = 0;

// A jump backwards is charged with its length. Since a scan goes forwards at most the length of the program plus what it has jumped back, that bounds its
// time.
#define NC_LADDER_JUMP(target)                                                               \
  {                                                                                          \
    const Unit* const to = units + (target);                                                 \
    if (to <= ip && !machine.charge(static_cast<std::uint32_t>(ip - to) + 1)) goto watchdog; \
    ip = to;                                                                                 \
    NC_LADDER_DISPATCH;                                                                      \
  }
#define NC_LADDER_NEXT(count) \
  {                           \
    ip += (count);            \
    NC_LADDER_DISPATCH;       \
  }
#define NC_LADDER_BYTE(value) static_cast<std::uint8_t>(value)
// An operation on words, which is executed when the result is on.
#define NC_LADDER_WORDS(name, count, statement) \
  NC_LADDER_CASE(name) {                        \
    if (rlo != 0) {                             \
      statement;                                \
    }                                           \
    NC_LADDER_NEXT(count)                       \
  }

#ifdef NC_LADDER_THREADED
  static const void* const kTargets[] = {
#define NC_LADDER_OP(name) &&l_##name,
      NC_LADDER_OPS_SHORT(NC_LADDER_OP) NC_LADDER_OPS_LONG(NC_LADDER_OP)
#undef NC_LADDER_OP
  };
#define NC_LADDER_DISPATCH goto* kTargets[ip->head.op]  // NOLINT(bugprone-macro-parentheses): a statement, not a value
#define NC_LADDER_CASE(name) l_##name:
  NC_LADDER_DISPATCH;
#else
#define NC_LADDER_DISPATCH goto dispatch
#define NC_LADDER_CASE(name) case Op::name:
#ifdef NC_LADDER_WATCHED
  const Unit* last = nullptr;  // the instruction that was executed last
dispatch:
  after(last, rlo);
  last = ip;
#else
dispatch:
#endif
  switch (static_cast<Op>(ip->head.op)) {
#define NC_LADDER_OP(name) case Op::name:
    NC_LADDER_OPS_LOGIC(NC_LADDER_OP)  // not reached, because lower() removes them
#undef NC_LADDER_OP
#endif

  NC_LADDER_CASE(kEnd) {
    if (depth != 0) return {kEndInCall, static_cast<std::uint32_t>(ip - units)};
    return {kNoFault, 0};
  }

  // Contacts, blocks, branches, coils.
#define NC_LADDER_RUN_CELL(unit)                                                            \
  {                                                                                         \
    const std::uint32_t in = (unit).cell.in;                                                \
    const std::uint32_t table = in >> kLogicShift >> (2 * (bit[in & (kMaxBits - 1)] & 1u)); \
    rlo = table >> rlo & 1u;                                                                \
    bit[(unit).cell.out] = NC_LADDER_BYTE(rlo);                                             \
    NC_LADDER_AFTER(&(unit));                                                               \
  }
  NC_LADDER_CASE(kCells) {
    const Unit* const end = ip + 1 + ip->head.a;
    ++ip;
    while (end - ip >= 4) {
      NC_LADDER_RUN_CELL(ip[0])
      NC_LADDER_RUN_CELL(ip[1])
      NC_LADDER_RUN_CELL(ip[2])
      NC_LADDER_RUN_CELL(ip[3])
      ip += 4;
    }
    for (; ip != end; ++ip) NC_LADDER_RUN_CELL(*ip)
    NC_LADDER_DISPATCH;
  }
  NC_LADDER_CASE(kCell){NC_LADDER_RUN_CELL(ip[1]) NC_LADDER_NEXT(2)}
  // Edges. With kEdgeUnknown (2) in the memory neither edge is reported: no level is above 2, and bit 0 of 2 is 0.
#define NC_LADDER_RISING(memory, now, result)  \
  std::uint8_t& before = bit[memory];          \
  const std::uint32_t level = (now);           \
  const std::uint32_t result = level > before; \
  before = NC_LADDER_BYTE(level)
#define NC_LADDER_FALLING(memory, now, result)             \
  std::uint8_t& before = bit[memory];                      \
  const std::uint32_t level = (now);                       \
  const std::uint32_t result = before & (level ^ 1u) & 1u; \
  before = NC_LADDER_BYTE(level)
  NC_LADDER_CASE(kMep) {
    NC_LADDER_RISING(ip->head.a, rlo, edge);
    rlo = edge;
    NC_LADDER_NEXT(1)
  }
  NC_LADDER_CASE(kMef) {
    NC_LADDER_FALLING(ip->head.a, rlo, edge);
    rlo = edge;
    NC_LADDER_NEXT(1)
  }
  NC_LADDER_CASE(kLdp) {
    NC_LADDER_RISING(ip[1].tail.b, bit[ip->head.a], edge);
    rlo = edge;
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kLdf) {
    NC_LADDER_FALLING(ip[1].tail.b, bit[ip->head.a], edge);
    rlo = edge;
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kAndp) {
    NC_LADDER_RISING(ip[1].tail.b, bit[ip->head.a], edge);
    rlo &= edge;
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kAndf) {
    NC_LADDER_FALLING(ip[1].tail.b, bit[ip->head.a], edge);
    rlo &= edge;
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOrp) {
    NC_LADDER_RISING(ip[1].tail.b, bit[ip->head.a], edge);
    rlo |= edge;
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOrf) {
    NC_LADDER_FALLING(ip[1].tail.b, bit[ip->head.a], edge);
    rlo |= edge;
    NC_LADDER_NEXT(2)
  }

  // Outputs.
  NC_LADDER_CASE(kSet) {
    if (rlo != 0) bit[ip->head.a] = 1;
    NC_LADDER_NEXT(1)
  }
  NC_LADDER_CASE(kRst) {
    if (rlo != 0) bit[ip->head.a] = 0;
    NC_LADDER_NEXT(1)
  }
  NC_LADDER_CASE(kPls) {
    NC_LADDER_RISING(ip[1].tail.b, rlo, edge);
    bit[ip->head.a] = NC_LADDER_BYTE(edge);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kPlf) {
    NC_LADDER_FALLING(ip[1].tail.b, rlo, edge);
    bit[ip->head.a] = NC_LADDER_BYTE(edge);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kFf) {
    NC_LADDER_RISING(ip[1].tail.b, rlo, edge);
    bit[ip->head.a] = NC_LADDER_BYTE(bit[ip->head.a] ^ edge);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOutTimer) {
    machine.run_timer(ip, rlo, false);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOutRetentive) {
    machine.run_timer(ip, rlo, true);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOutCounter) {
    machine.run_counter(ip, rlo);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_WORDS(kRstTimer, 1, machine.reset_timer(ip->head.a))
  NC_LADDER_WORDS(kRstCounter, 1, machine.reset_counter(ip->head.a))
  // A P form: unless there is a rising edge, the next instruction, which has `mode` units, is skipped.
  NC_LADDER_CASE(kSkipNotRising) {
    NC_LADDER_RISING(ip->head.a, rlo, edge);
    NC_LADDER_NEXT(1 + (edge != 0 ? 0u : ip->head.mode))
  }

  // Flow.
  NC_LADDER_CASE(kJump) NC_LADDER_JUMP(ip->head.a) NC_LADDER_CASE(kJumpIf) {
    if (rlo != 0) NC_LADDER_JUMP(ip->head.a)
    NC_LADDER_NEXT(1)
  }
  NC_LADDER_CASE(kCall) {
    if (rlo == 0) NC_LADDER_NEXT(1)
    if (depth == kMaxCalls) return {kCallStack, static_cast<std::uint32_t>(ip - units)};
    frames[depth++] = {ip + 1, rlo};
    NC_LADDER_JUMP(ip->head.a)
  }
  NC_LADDER_CASE(kRet) {
    if (depth == 0) return {kReturnNoCall, static_cast<std::uint32_t>(ip - units)};
    const Frame& frame = frames[--depth];
    rlo = frame.rlo;
    NC_LADDER_JUMP(frame.back - units)
  }
  NC_LADDER_CASE(kFor) {
    std::int32_t n;
    if (!machine.get16(ip, 0, &n)) n = 0;
    machine.save32(ip[1].tail.b, n);
    if (n < 1) NC_LADDER_JUMP(ip[1].tail.c)
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kNext) {
    const std::int32_t left = machine.load32(ip[1].tail.b) - 1;
    machine.save32(ip[1].tail.b, left);
    if (left > 0) NC_LADDER_JUMP(ip[1].tail.c)
    NC_LADDER_NEXT(2)
  }

  // Compares.
  NC_LADDER_CASE(kLdCompare) {
    rlo = machine.compare16(ip);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kAndCompare) {
    rlo &= machine.compare16(ip);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOrCompare) {
    rlo |= machine.compare16(ip);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kLdCompare32) {
    rlo = machine.compare32(ip);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kAndCompare32) {
    rlo &= machine.compare32(ip);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kOrCompare32) {
    rlo |= machine.compare32(ip);
    NC_LADDER_NEXT(2)
  }

  // 16 bits.
  NC_LADDER_WORDS(kMov, 2, machine.unary16(ip, 0, 1, [](std::int32_t v) { return v; }))
  NC_LADDER_WORDS(kCml, 2, machine.unary16(ip, 0, 1, [](std::int32_t v) { return ~v; }))
  NC_LADDER_WORDS(kXch, 2, machine.exchange16(ip))
  NC_LADDER_WORDS(kBcd, 2, machine.to_bcd(ip, 4, false))
  NC_LADDER_WORDS(kBin, 2, machine.from_bcd(ip, 4, false))
  NC_LADDER_WORDS(kAdd, 2, machine.binary16(ip, [](std::int32_t l, std::int32_t r) { return l + r; }))
  NC_LADDER_WORDS(kSub, 2, machine.binary16(ip, [](std::int32_t l, std::int32_t r) { return l - r; }))
  NC_LADDER_WORDS(kMul, 2, machine.multiply16(ip))
  NC_LADDER_WORDS(kDiv, 2, machine.divide16(ip))
  NC_LADDER_WORDS(kInc, 2, machine.unary16(ip, 0, 0, [](std::int32_t v) { return v + 1; }))
  NC_LADDER_WORDS(kDec, 2, machine.unary16(ip, 0, 0, [](std::int32_t v) { return v - 1; }))
  NC_LADDER_WORDS(kNeg, 2, machine.unary16(ip, 0, 0, [](std::int32_t v) { return -v; }))
  NC_LADDER_WORDS(kWand, 2, machine.binary16(ip, [](std::int32_t l, std::int32_t r) { return l & r; }))
  NC_LADDER_WORDS(kWor, 2, machine.binary16(ip, [](std::int32_t l, std::int32_t r) { return l | r; }))
  NC_LADDER_WORDS(kWxor, 2, machine.binary16(ip, [](std::int32_t l, std::int32_t r) { return l ^ r; }))
  NC_LADDER_WORDS(kRor, 2, machine.rotate(ip, false, true))
  NC_LADDER_WORDS(kRol, 2, machine.rotate(ip, false, false))
  NC_LADDER_WORDS(kSfr, 2, machine.shift(ip, true))
  NC_LADDER_WORDS(kSfl, 2, machine.shift(ip, false))
  NC_LADDER_WORDS(kBset, 2, machine.bit_of_word(ip, true))
  NC_LADDER_WORDS(kBrst, 2, machine.bit_of_word(ip, false))
  NC_LADDER_WORDS(kRstWord, 2, machine.put16(ip, 0, 0))

  // 32 bits.
  NC_LADDER_WORDS(kDmov, 2, machine.unary32(ip, 0, 1, [](std::uint32_t v) { return v; }))
  NC_LADDER_WORDS(kDcml, 2, machine.unary32(ip, 0, 1, [](std::uint32_t v) { return ~v; }))
  NC_LADDER_WORDS(kDxch, 2, machine.exchange32(ip))
  NC_LADDER_WORDS(kDbcd, 2, machine.to_bcd(ip, 8, true))
  NC_LADDER_WORDS(kDbin, 2, machine.from_bcd(ip, 8, true))
  NC_LADDER_WORDS(kDadd, 2, machine.binary32(ip, [](std::uint32_t l, std::uint32_t r) { return l + r; }))
  NC_LADDER_WORDS(kDsub, 2, machine.binary32(ip, [](std::uint32_t l, std::uint32_t r) { return l - r; }))
  NC_LADDER_WORDS(kDmul, 2, machine.multiply32(ip))
  NC_LADDER_WORDS(kDdiv, 2, machine.divide32(ip))
  NC_LADDER_WORDS(kDinc, 2, machine.unary32(ip, 0, 0, [](std::uint32_t v) { return v + 1u; }))
  NC_LADDER_WORDS(kDdec, 2, machine.unary32(ip, 0, 0, [](std::uint32_t v) { return v - 1u; }))
  NC_LADDER_WORDS(kDneg, 2, machine.unary32(ip, 0, 0, [](std::uint32_t v) { return 0u - v; }))
  NC_LADDER_WORDS(kDwand, 2, machine.binary32(ip, [](std::uint32_t l, std::uint32_t r) { return l & r; }))
  NC_LADDER_WORDS(kDwor, 2, machine.binary32(ip, [](std::uint32_t l, std::uint32_t r) { return l | r; }))
  NC_LADDER_WORDS(kDwxor, 2, machine.binary32(ip, [](std::uint32_t l, std::uint32_t r) { return l ^ r; }))
  NC_LADDER_WORDS(kDror, 2, machine.rotate(ip, true, true))
  NC_LADDER_WORDS(kDrol, 2, machine.rotate(ip, true, false))
  NC_LADDER_WORDS(kRstWord32, 2, machine.put32(ip, 0, 0))

  // A bit of a word, such as D0.5: kWordBit copies the bit b of word a into bit c before the instruction that works on it, and kBitWord copies it back after
  // it. The result of logic does not change.
  NC_LADDER_CASE(kWordBit) {
    bit[ip[1].tail.c] = NC_LADDER_BYTE(static_cast<std::uint16_t>(word[ip->head.a]) >> ip[1].tail.b & 1u);
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kBitWord) {
    const std::uint32_t mask = 1u << ip[1].tail.b;
    const std::uint32_t old = static_cast<std::uint16_t>(word[ip->head.a]);
    word[ip->head.a] = static_cast<std::int16_t>(
        static_cast<std::uint16_t>(bit[ip[1].tail.c] != 0 ? old | mask : old & ~mask));
    NC_LADDER_NEXT(2)
  }

  // Rows.
  NC_LADDER_WORDS(kBmov, 2, if (!machine.block_move(ip)) goto watchdog)
  NC_LADDER_WORDS(kFmov, 2, if (!machine.fill(ip)) goto watchdog)
  NC_LADDER_WORDS(kSer, 3, if (!machine.search(ip, false)) goto watchdog)
  NC_LADDER_WORDS(kDser, 3, if (!machine.search(ip, true)) goto watchdog)
  NC_LADDER_WORDS(kRots, 3, machine.shortest_way(ip))
  NC_LADDER_CASE(kZrstBits) {
    if (rlo != 0) {
      if (!machine.charge(ip[1].tail.b / 16)) goto watchdog;
      std::memset(bit + ip->head.a, 0, ip[1].tail.b);
    }
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kZrstWords) {
    if (rlo != 0) {
      if (!machine.charge(ip[1].tail.b / 8)) goto watchdog;
      std::memset(word + ip->head.a, 0, ip[1].tail.b * sizeof *word);
    }
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kZrstTimers) {
    if (rlo != 0) {
      if (!machine.charge(ip[1].tail.b)) goto watchdog;
      for (std::uint32_t i = 0; i < ip[1].tail.b; ++i) machine.reset_timer(ip->head.a + i);
    }
    NC_LADDER_NEXT(2)
  }
  NC_LADDER_CASE(kZrstCounters) {
    if (rlo != 0) {
      if (!machine.charge(ip[1].tail.b)) goto watchdog;
      for (std::uint32_t i = 0; i < ip[1].tail.b; ++i) machine.reset_counter(ip->head.a + i);
    }
    NC_LADDER_NEXT(2)
  }

#ifndef NC_LADDER_THREADED
}
#endif

watchdog : return {kWatchdog, static_cast<std::uint32_t>(ip - units)};
}

#undef NC_LADDER_JUMP
#undef NC_LADDER_NEXT
#undef NC_LADDER_BYTE
#undef NC_LADDER_WORDS
#undef NC_LADDER_DISPATCH
#undef NC_LADDER_CASE
#undef NC_LADDER_RUN_CELL
#undef NC_LADDER_AFTER
#undef NC_LADDER_RISING
#undef NC_LADDER_FALLING
