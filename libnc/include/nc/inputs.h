/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file inputs.h
 * What the scan gives to a part system in one cycle: buttons and switches, what is measured, and what is moved by hand. nc_cycle() takes it.
 */
#ifndef NC_INPUTS_H
#define NC_INPUTS_H

#include "nc/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Manual motion of one axis. While manual motion cannot act (nc_outputs::manual_allowed is off, feed hold, interlock, the axis is a spindle now, a tap
 * stands in its hole: nc_outputs::tap_holds)
 * commands are refused, and a motion that is under way comes to rest and is given up. It does not begin again by itself: a kind that stays
 * commanded until manual motion is possible again does nothing until another kind, or NC_MANUAL_NONE, or a jog at velocity 0 has been commanded in
 * between. The operator has to release the button first.
 */
typedef enum nc_manual_kind {
  NC_MANUAL_NONE = 0,
  NC_MANUAL_JOG = 1,      /**< the axis moves with `velocity` as long as this is commanded */
  NC_MANUAL_STEP = 2,     /**< the axis moves by `distance` once, when this kind begins to be commanded */
  NC_MANUAL_HANDLE = 3,   /**< a handle (hand wheel) asks for `distance` more in this cycle: the axis goes to where all these distances together lead.
                               When the handle is turned faster than the axis can go, the target is at most the way of 0.5 s at the top speed of the
                               axis plus its braking distance ahead; the rest of the way is dropped, so that the axis is at rest soon after the
                               wheel. Also dropped is the way beyond a soft limit, the way commanded while commands are refused, and the way that
                               a stop or a jog ends. nc_outputs::handle_dropped tells it */
  NC_MANUAL_REFERENCE = 4, /**< the axis goes to its first reference position. Where the family says so, its length compensation ends there, and along the axis of the tool
                               that of any axis which has to do with it: with the next start, and without a movement (M700 12.2 (4), 12.3). Not while a program that
                               is begun inside has not gone on */
  NC_MANUAL_RETURN = 5    /**< in a block stop: the axis goes back to where the program, or the blocks of MDI behind it, have left it, or, where the program is begun inside (nc/restart.h), to where it
                               goes on; in a feed hold to where its path has stopped. An axis that stands there already does not move. Of a velocity the amount counts, 0 means the top speed of the axis */
} nc_manual_kind;

typedef struct nc_manual {
  uint8_t kind;    /**< nc_manual_kind */
  double velocity; /**< mm/s or deg/s, signed, -1e6..1e6, and either 0 or not nearer to 0 than 0.000001. Of a step 0 means the top speed of the axis */
  double distance; /**< mm or deg, signed, -1e6..1e6 */
} nc_manual;

#define NC_SPINDLE_AGE_MAX 0.06 /**< greatest nc_inputs::spindle_age_s, s. Of a cycle below 0.12 ms an age counts as 511 cycles at most */

#define NC_TOOL_ANGLE_MAX 1e6 /**< greatest amount of an nc_inputs::tool_angle and nc_world::tool_angle, deg */

/** What is measured of a spindle. */
typedef struct nc_spindle_inputs {
  double rev_per_s;  /**< actual speed, rev/s, signed, -10000..10000; below 0.00001 the spindle counts as standing. Used by feed per revolution, threads
                          and dwell in revolutions */
  double turns;      /**< position of its encoder, revolutions, -1e12..1e12, counting on with the sign of the speed; at whole numbers is its zero mark (Z
                          phase) */
  bool turns_valid;  /**< true: `turns` is measured; false: it is not, and threads begin at any angle */
  bool servo_ready;  /**< the spindle holds its position and follows the command of its C axis (M700 10.5: servo READY) */
  bool zero_passed;  /**< the Z phase has been passed since the servo was switched on: the reference position return is complete */
  bool unmeasured;   /**< true: the speed is not measured, or not now. It counts as 0, and what needs it waits with NC_CAUSE_SPINDLE_UNMEASURED */
} nc_spindle_inputs;

/** Bits of nc_outputs::inputs_refused: which inputs were not accepted, and what acts in their place. */
typedef enum nc_input_bits {
  NC_INPUT_FEED_OVERRIDE = 1,  /**< the last accepted feed override acts */
  NC_INPUT_RAPID_OVERRIDE = 2, /**< the last accepted rapid override acts */
  NC_INPUT_SPINDLE = 4,        /**< the spindle counts as turning on with its last speed for 20 ms, then as `unmeasured` until an input is accepted */
  NC_INPUT_ACTUAL = 8,         /**< the axis counts as standing at its last accepted position, but not as in position */
  NC_INPUT_MANUAL = 16,        /**< nothing is commanded by hand for the axis; set also for a kind that is no nc_manual_kind */
  NC_INPUT_MANUAL_FEED = 32,   /**< the last accepted manual feed rate acts */
  NC_INPUT_SKIP_PLACE = 64,    /**< the skip signals count as not latched */
  NC_INPUT_TOOL_LENGTH = 128,  /**< the handle adds nothing to the tool length */
  NC_INPUT_TOOL_ANGLE = 256    /**< the last accepted angles of the tool act, 0 where there were none */
} nc_input_bits;

/**
 * What the scan gives to one part system in one cycle. A number that is not finite, or out of the range given beside its member, is refused:
 * nc_input_bits says what acts in its place, and nc_outputs::inputs_refused reports it. Members without a range may have any value of their type.
 */
typedef struct nc_inputs {
  NC_STRUCT_SIZE(nc_inputs); /**< see NC_STRUCT_SIZE */
  bool cycle_start;      /**< rising edge: a program starts or continues */
  bool feed_hold;        /**< level: motion decelerates on the path and stays at rest */
  bool reset;            /**< rising edge: motion stops on the path and the program is given up; while the level is on, nothing starts */
  bool single_block;     /**< level: the program stops at the end of each block */
  bool optional_stop;    /**< level: M01 stops */
  /* Completion of the M, S, T or B that is waited for. A signal that is already on when the strobe rises does not count until it has been off. */
  bool fin;              /**< FIN1: when it rises the strobes go off, when it falls the program goes on */
  bool fin2;             /**< FIN2: when it rises the strobes go off and the program goes on */
  bool interlock;        /**< level: no axis may start; motion decelerates to rest */
  bool alarm;            /**< level: motion stops, and nothing starts until reset (an alarm of a drive or of the PLC) */
  bool recalculate;      /**< rising edge while a program runs: at the end of the block in execution, what was read beyond it is read again (M700 4.2,
                              10.5) */
  bool macro_interrupt;  /**< UIT, M700 13.12: the interrupt program of M96 runs at once (type 1), or at the end of the block in execution (type 2) */
  uint32_t mirror;       /**< bit n: a program that is started now is mirrored in axis n about the position of the axis. nc_switches_set() and #8211 can
                              ask for the same */
  uint32_t unclamped;    /**< bit n: on: axis n of an index table is unclamped, the answer to nc_outputs::unclamp; off: it is clamped (M700 9.3) */
  uint32_t skip;         /**< skip signals, bit n = signal n+1 */
  uint32_t input[NC_WORDS]; /**< macro interface inputs, words of #1032..#1035 */
  double feed_override;  /**< 0..max_feed_override, 1 = 100 %; a value nearer to 0 than 0.0001 counts as 0 */
  double rapid_override; /**< 0..1, 1 = 100 %; a value nearer to 0 than 0.0001 counts as 0 */
  nc_spindle_inputs spindle[NC_MAX_SPINDLES]; /**< what is measured of each spindle */
  uint8_t spindle_select;   /**< SWS, M700 10.6: bit n: spindle n+1 follows the S command; a spindle that is the only one always follows it */
  uint8_t spindle_encoder;  /**< number (from 1) of the spindle whose encoder is used by feed per revolution, threads and dwell; 0 = the selected spindle */
  uint8_t servo_on;         /**< M700 10.5: bit i: axis i, which is a spindle too, is to be a C axis */
  int32_t feed_pulses;      /**< pulses of the first handle in this cycle: they change the feed of F1 to F5 (M700 7.3) */
  bool actual_valid;     /**< true: `actual` holds measured positions; false: the commanded positions count as the actual ones */
  nc_axes actual;        /**< measured machine position, mm or deg, -1e9..1e9; read only while `actual_valid` is true */
  bool follow_up;        /**< level, for times when the drives are off: while no program runs the commanded position follows `actual` */
  nc_manual manual[NC_MAX_AXES]; /**< manual motion of each axis, while nc_outputs::manual_allowed is on; a program in a block stop goes on from where it
                                      has led, one that a feed hold has stopped only when the axes are back (nc_outputs::restart_axes), whatever `manual_absolute_off` is */
  bool manual_absolute_off; /**< level, read when cycle start goes on from a block stop in which axes were moved by hand. True: the coordinate systems are
                                 moved along with these axes. False (manual absolute is on): the coordinate systems stay, and an absolute command
                                 goes to its programmed position (M700 12.4.4, 14.12) */
  int64_t clock_ms;      /**< wall clock (see nc_world) */
  uint64_t unlimited;    /**< bit n: axis n does not know where it stands yet, and its soft limits do not hold for motion by hand. It counts where a motion begins
                              and while it goes on: a motion that goes on when the bit goes off ends where it was to end */
  bool tap_retract;      /**< rising edge while nc_outputs::tap_retract_possible: a synchronous tap is drawn out of its hole, up to R. While it is off the
                              tap stands there and goes on when it is on again; a reset, a feed hold and an interlock give the way up */
  bool tool_broken;      /**< rising edge: the tool in the spindle is not used any more: its status in the table of tool life becomes 3 */
  double manual_feed;    /**< manual feed rate, mm/s along the path, 0..1e6; the feed override acts on it. Read only in dry run, and until
                              the end of a thread that has begun in it */
  uint64_t locked;       /**< machine lock, bit n: axis n is commanded, but its drive does not follow. libnc has to know because a skip move ends by no
                              signal when all the axes that it moves are locked (M700 15.2 (8)); what keeps the drives still is the host's */
  uint8_t fin_groups;    /**< completion of one group alone, bits as in nc_outputs::strobe, each of them as `fin`: when it rises the strobe of its group
                              goes off, when it falls that group is complete */
  bool auxiliary_lock;   /**< level: M, S, T and B are neither given out nor waited for, but for those that stop or end the program (M00, M01, M02, M30).
                              It counts where a code would be given out; one that waits already is completed */
  bool dry_run;          /**< level: cuts go at `manual_feed` in place of their feed, and so do rapid moves where the family's parameter says so (M700
                              #1085). Not so skip moves (M700 15.2), the tapping mode and taps (13.1.1). Of a thread the level counts where it begins, and
                              such a thread does not go with the spindle (6.7.1) */
  bool manual_rapid;     /**< level: in dry run rapid moves go as they are commanded, and cuts at the most that the axes may cut with */
  nc_axes skip_place;    /**< measured machine position at which a signal of `skip_latched` came, mm or deg, -1e9..1e9; read only where such a signal ends a
                              skip move */
  uint32_t skip_latched; /**< bit n: what measures has noted where the axes were when skip signal n+1 came, as a touch probe input of a drive does.
                              `skip_place` is then the skip position (M700 15.2). A signal that is not here, or that is on already where the skip move begins, has the
                              measured or commanded position of the cycle in which it is seen */
  double spindle_age_s[NC_MAX_SPINDLES]; /**< the age of `turns` of each spindle against the commands, seconds, 0..NC_SPINDLE_AGE_MAX: 0 where they were measured while
                              the axes stood at the commands of the cycle before, one cycle more where they stood at the commands of the one before that, as behind
                              a bus. The axis of a synchronous tap (M700 13.1.1) is compared with its spindle at that moment; a lag of its drive belongs to it */
  double tool_length_handle; /**< way by which a handle changes, in this cycle, the length that is compensated along the tool axis (G43.1, M700 12.3), mm, signed, -1e6..1e6.
                              It is added to the amount of the number in force (nc_outputs::tool_length_added) and moves nothing at once: blocks behind the one in
                              execution go with the new amount, and are read again for it, so the axes come to rest at its end. It counts while a program stands in
                              a block stop or a feed hold or cuts, and length is compensated along the tool axis; not in rapid traverse, under an alarm, during a
                              reset, in an interrupt program, and where a program that is begun inside has not gone on: nc_outputs::tool_length_dropped tells it */
  double tool_angle[2];  /**< angles of a head that is no axis of the part system (nc_system_config::tool_axis), deg, at most NC_TOOL_ANGLE_MAX either way: [0] about X or Y (A, B), [1] about Z (C).
                              Read only with NC_TOOL_AXIS_MECHANICAL_A or _B, where a block needs them: when it has G43.1, and with G43.1 in force behind M, S, T and B, since
                              what is given out by them may have turned the head. That block waits until everything before it has been executed */
} nc_inputs;
/**
 * Clear the struct, set its size, and set both overrides to 100 %: the inputs of a machine at which no switch is on. Any thread.
 * @param inputs what is to be set; not NULL
 */
static inline void nc_inputs_init(nc_inputs* inputs) {
  const nc_inputs cleared = NC_INIT(nc_inputs);
  *inputs = cleared;
  inputs->feed_override = 1;
  inputs->rapid_override = 1;
}

#ifdef __cplusplus
}
#endif

#endif
