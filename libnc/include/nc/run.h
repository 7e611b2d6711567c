/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file run.h
 * Run a program: offline by pulling its items, or online by feeding and cycling a machine.
 *
 *   offline:  nc_program_select -> nc_pull until NC_ENDED/NC_ALARMED, answering syncs with nc_answer
 *   online :  feeder thread: nc_feed() again and again        scan thread: nc_cycle() once per servo cycle
 *
 * The two threads share nothing but single-producer single-consumer rings and one versioned plan inside the control.
 */
#ifndef NC_RUN_H
#define NC_RUN_H

#include "nc/control.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- offline ------------------------------------------------------------------------------------------------------ */

/**
 * Offline: next item of a part system. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param budget blocks that may be read before the call gives up with NC_BUDGET (an endless GOTO makes no items)
 * @param item receives it
 * @return NC_OK with *item; NC_WAITING while a sync is not answered; NC_BUDGET; NC_ENDED after the end item; NC_ALARMED after the alarm and
 *         end items; NC_E_STATE: the program runs online; NC_E_ARGUMENT: no such part system, a pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_pull(nc_control* control, unsigned system, uint32_t budget, nc_item* item);

/**
 * Offline: a point of the move that nc_pull() gave last. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param share of its length that is done there, 0 to 1
 * @param machine receives the point, machine coordinates, mm or deg
 * @return NC_OK; NC_E_STATE: there is no such move, or the program runs online; NC_E_ARGUMENT: no such part system, `share` is out of range, or a
 *         pointer is NULL
 */
NC_API nc_status nc_move_point(const nc_control* control, unsigned system, double share, nc_axes* machine);

/**
 * Offline: zero of the workpiece coordinates of the move that nc_pull() gave last, with the tool length that the move applies in it. A
 * point of the move less this is where the tip of the tool is on the workpiece; radius compensation stays in the path. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param zero receives it, machine coordinates, mm or deg
 * @return as nc_move_point()
 */
NC_API nc_status nc_move_zero(const nc_control* control, unsigned system, nc_axes* zero);

/**
 * Offline: answer the open sync of a part system. After NC_SYNC_SKIP the interpreter goes on from world->machine. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param world the machine when everything before the sync had happened; copied
 * @return NC_OK; NC_E_STATE: no sync is open, or the program runs online, where the scan answers; NC_E_ARGUMENT: no such part system, a
 *         number that is not finite, or a struct_size that is not valid
 */
NC_API nc_status nc_answer(nc_control* control, unsigned system, const nc_world* world);

/**
 * Offline: give up what was read beyond `serial` and read it again from there: switches, offsets and variables that were changed since
 * then act from the next block on. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param serial of a mark that is not older than the look-ahead; 0 = from the start of the program
 * @return NC_OK; NC_E_NOT_FOUND: no such mark, or no longer; NC_E_STATE: the program runs online; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_rewind(nc_control* control, unsigned system, uint64_t serial);

/**
 * Online, at rest in a block stop or a hold: give up what was read beyond the block in execution and read it again (M700 4.2
 * "recalculation request"). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @return NC_OK when it is done, or no program runs; NC_WAITING until the scan has agreed, which it does at rest only (call again);
 *         NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_recalculate(nc_control* control, unsigned system);

/**
 * Offline: the level of the macro interrupt signal UIT (M700 13.12), to be told when it changes. The item that was pulled last counts as
 * not executed yet. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param on the level
 * @param take_back receives whether that item must not be executed any more (type 1 of the interrupt)
 * @return NC_OK; NC_E_STATE: the program runs online, where the signal comes with nc_inputs; NC_E_ARGUMENT: no such part system, or a
 *         pointer is NULL
 */
NC_API nc_status nc_interrupt_signal(nc_control* control, unsigned system, bool on, bool* take_back);

/**
 * Stop the program: modal state as after reset (M700 3.7 "reset 2"), program at its head. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @return NC_OK; NC_E_STATE: online motion runs, which nc_inputs::reset stops; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_reset(nc_control* control, unsigned system);

/* ---- online: feeder ----------------------------------------------------------------------------------------------- */

/**
 * Online: read, compensate, plan and commit ahead of the machine, for every part system. Feeder thread.
 * @param control the control
 * @param budget blocks that may be read in this call for each part system
 * @return NC_OK when something was committed; NC_WAITING when nothing can be done until the scan goes on; NC_BUDGET; NC_ENDED when every
 *         program is committed to its end; NC_ALARMED; NC_E_ARGUMENT: `control` is NULL
 */
NC_API nc_status nc_feed(nc_control* control, uint32_t budget);

/** What the scan has reached, in order. */
typedef struct nc_event {
  NC_STRUCT_SIZE(nc_event); /**< see NC_STRUCT_SIZE */
  uint64_t serial;
  nc_source source;
  uint8_t kind;    /**< nc_item_kind of the item that has been executed to its end */
  bool again;      /**< a mark: its block's M99 begins the main program again (M700 13.3.1) */
  nc_axes machine; /**< commanded position at that moment */
} nc_event;
/**
 * Clear it and set its size. Any thread.
 * @param event what is to be cleared; not NULL
 */
static inline void nc_event_init(nc_event* event) {
  const nc_event cleared = NC_INIT(nc_event);
  *event = cleared;
}

/**
 * Next executed item. Events are kept for at least `look_ahead` items; when they are not fetched the oldest are dropped and counted.
 * Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param event receives it
 * @param dropped receives how many were dropped since the last call. May be NULL.
 * @return NC_OK; NC_E_NOT_FOUND: nothing further has been executed; NC_E_ARGUMENT: no such part system, `event` is NULL, or its
 *         struct_size is not valid
 */
NC_API nc_status nc_event_poll(nc_control* control, unsigned system, nc_event* event, uint64_t* dropped);

/**
 * The block at which reading stands because it asks for what exists only when everything before it has been executed (a position, an
 * input). A simulated machine learns from it what it has to give before the scan gets there. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param source receives the block
 * @param main_line receives the line of the main program: of the block, or of the one that has called the program in which it stands
 * @return NC_OK; NC_E_NOT_FOUND: reading does not stand at such a block; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_sync_get(const nc_control* control, unsigned system, nc_source* source, uint32_t* main_line);

/**
 * The line of the main program to which a block belongs: of the block itself, or of the one that has called the program in which it stands.
 * Of the item that nc_pull() has given last, or of the one that an nc_commit_watch is given. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param source nc_item::source of that item
 * @param main_line receives the line, from 1; 0: none is known
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_main_line_get(const nc_control* control, unsigned system, const nc_source* source, uint32_t* main_line);

/**
 * Called by nc_feed() with each item before it is committed, in the order of the stream: what a simulated machine has to do when it gets there
 * can be prepared. Serials go back when what was read ahead is read again (recalculation, macro interrupt, reset): the items given from the
 * repeated serial on are void. Functions that change the program or its tables must not be called in it. Feeder thread.
 * @param user what nc_commit_watch_set() was given
 * @param item as nc_pull() would give it; of nc_feed(), not to be kept
 * @return true: it is committed; false: neither it nor anything behind it yet, and the next nc_feed() asks again
 */
typedef bool (*nc_commit_watch)(void* user, const nc_item* item);

/**
 * Watch what is committed online. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param watch called from now on, until another one is set; NULL: none, as in the beginning
 * @param user handed to it
 * @return NC_OK; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_commit_watch_set(nc_control* control, unsigned system, nc_commit_watch watch, void* user);

/* ---- online: scan ------------------------------------------------------------------------------------------------- */

/**
 * Manual motion of one axis. While it cannot act (nc_outputs::manual_allowed is off, feed hold, interlock, the axis is a spindle now) commands are
 * refused, and a motion that is under way comes to rest and is given up. It does not begin again by itself: a kind that stays commanded until
 * it could act again does nothing until another kind, or none (or a jog at velocity 0), has been commanded in between, as when a button is released.
 */
typedef enum nc_manual_kind {
  NC_MANUAL_NONE = 0,
  NC_MANUAL_JOG = 1,      /**< `velocity` as long as it is commanded */
  NC_MANUAL_STEP = 2,     /**< `distance` once per rising edge */
  NC_MANUAL_HANDLE = 3,   /**< `distance` is added in this cycle: the axis ends where all of them together say. Of a handle that is turned faster
                               than the axis can go, what lies more than 0.5 s at its top speed and its braking distance ahead of the axis is
                               dropped, so that it is at rest half a second and its ramps behind the wheel; so is what lies beyond a soft
                               limit, what is given in a refusal and what a stop or a jog gives up: nc_outputs::handle_dropped */
  NC_MANUAL_REFERENCE = 4 /**< go to the first reference position */
} nc_manual_kind;

typedef struct nc_manual {
  uint8_t kind;    /**< nc_manual_kind */
  double velocity; /**< mm/s or deg/s, signed, -1e6..1e6; 0, or at least 0.000001 away from it. For a step 0 = as fast as the axis can */
  double distance; /**< mm or deg, signed, -1e6..1e6 */
} nc_manual;

/** What a spindle measures. */
typedef struct nc_spindle_inputs {
  double rev_per_s;  /**< actual speed, signed, -10000..10000; below 0.00001 the spindle counts as standing. Used by feed per revolution, threads and
                          dwell in revolutions */
  double turns;      /**< its encoder, revolutions, -1e12..1e12, counting on with the sign of the speed; whole numbers are its zero mark (Z phase) */
  bool turns_valid;  /**< `turns` is measured; without it threads begin at any angle */
  bool servo_ready;  /**< it holds its position and follows the command of its C axis (M700 10.5: servo READY) */
  bool zero_passed;  /**< the Z phase has been passed since the servo was switched on: reference position return complete */
  bool unmeasured;   /**< nothing measures it, or not now: the speed counts as 0, and what needs it waits with NC_CAUSE_SPINDLE_UNMEASURED */
} nc_spindle_inputs;

/** Bits of nc_outputs::inputs_refused. */
typedef enum nc_input_bits {
  NC_INPUT_FEED_OVERRIDE = 1,  /**< the last good one holds */
  NC_INPUT_RAPID_OVERRIDE = 2, /**< the last good one holds */
  NC_INPUT_SPINDLE = 4,        /**< it goes on as it was for 20 ms, then it is `unmeasured` until it is good again */
  NC_INPUT_ACTUAL = 8,         /**< the axis is where it was last; in position it is not */
  NC_INPUT_MANUAL = 16         /**< the axis is as if nothing was commanded by hand; a kind that there is not, too */
} nc_input_bits;

/**
 * What the scan gives to one part system in one cycle. A number that is not finite or out of the range that stands beside it never acts:
 * nc_input_bits says what acts in its place, and nc_outputs::inputs_refused that this was so. All fields without a range may have any value of
 * their type.
 */
typedef struct nc_inputs {
  NC_STRUCT_SIZE(nc_inputs); /**< see NC_STRUCT_SIZE */
  bool cycle_start;      /**< rising edge starts or continues */
  bool feed_hold;        /**< level: decelerate on the path and stay */
  bool reset;            /**< rising edge: stop on the path, give the program up; while it is on, nothing is started */
  bool single_block;     /**< level: stop at the end of each block */
  bool optional_stop;    /**< level: M01 stops */
  /* Completion of the M, S, T or B in wait. One that is on when the strobe rises does not count until it has been off. */
  bool fin;              /**< FIN1: when it rises the strobes go off, when it falls the program goes on */
  bool fin2;             /**< FIN2: when it rises the strobes go off and the program goes on */
  bool interlock;        /**< level: no axis may start; motion decelerates to rest */
  bool alarm;            /**< level: stop motion, no start until reset (a drive, the PLC) */
  bool recalculate;      /**< rising edge while a program runs: what was read beyond the block in execution is read again at its end (M700 4.2, 10.5) */
  bool macro_interrupt;  /**< UIT, M700 13.12: the interrupt program of M96 comes at once (type 1), or at the end of the block in execution */
  uint32_t mirror;       /**< bit n: a program that is started now is mirrored in axis n about where the axis stands, beside nc_switches_set() and #8211 */
  uint32_t unclamped;    /**< bit n: axis n of an index table is unclamped, as nc_outputs::unclamp asks for; off: clamped (M700 9.3) */
  uint32_t skip;         /**< skip signals, bit n = signal n+1 */
  uint32_t input[NC_WORDS]; /**< macro interface inputs */
  double feed_override;  /**< 0..max_feed_override, 1 = 100 %; what is nearer to 0 than 0.0001 is 0 */
  double rapid_override; /**< 0..1, in the same way */
  nc_spindle_inputs spindle[NC_MAX_SPINDLES];
  uint8_t spindle_select;   /**< SWS, M700 10.6: bit n: spindle n+1 follows the S command; where there is one spindle it always does */
  uint8_t spindle_encoder;  /**< number of the spindle whose encoder counts for feed per revolution, threads and dwell; 0 = the selected one's */
  uint8_t servo_on;         /**< M700 10.5: bit i: axis i, which is a spindle too, is to be a C axis */
  int32_t feed_pulses;      /**< pulses of the first handle in this cycle: they change the feed of F1 to F5 (M700 7.3) */
  bool actual_valid;     /**< `actual` holds measured positions; otherwise commanded = actual */
  nc_axes actual;        /**< measured machine position, -1e9..1e9; asked for while `actual_valid` */
  bool follow_up;        /**< level, while drives are off: with no program the commanded position follows `actual` */
  nc_manual manual[NC_MAX_AXES]; /**< acts while nc_outputs::manual_allowed; a program in a block stop goes on from there */
  bool manual_absolute_off; /**< level, looked at when cycle start goes on from a block stop in which axes were moved by hand. True: the coordinate systems
                                 are moved along with these axes. False (manual absolute is on): the systems stay, and an absolute command goes to its
                                 programmed place (M700 12.4.4, 14.12) */
  int64_t clock_ms;      /**< wall clock (see nc_world) */
  uint64_t unlimited;    /**< bit n: axis n does not know where it stands yet, and its soft limits do not hold for motion by hand. It counts where a motion begins
                              and while it goes on: a motion that goes on when the bit goes off ends where it was to end */
} nc_inputs;
/**
 * Clear it, set its size and both overrides to 100 %: a machine that nobody touches. Any thread.
 * @param inputs what is to be set; not NULL
 */
static inline void nc_inputs_init(nc_inputs* inputs) {
  const nc_inputs cleared = NC_INIT(nc_inputs);
  *inputs = cleared;
  inputs->feed_override = 1;
  inputs->rapid_override = 1;
}

/** Run state of a part system. */
typedef enum nc_run_state {
  NC_STATE_IDLE = 0,    /**< no program started, or ended, or reset */
  NC_STATE_RUNNING = 1,
  NC_STATE_HOLD = 2,    /**< feed hold: at rest on the path, or on the way there */
  NC_STATE_STOPPED = 3, /**< block stop: single block, M00, M01; cycle start continues */
  NC_STATE_ALARM = 4,
  NC_STATE_MANUAL = 5
} nc_run_state;

/** Why nothing moves though a program runs; what an operator asks first. */
typedef enum nc_stop_cause {
  NC_CAUSE_NONE = 0,
  NC_CAUSE_FIN = 1,         /**< waits for FIN of M/S/T/B, or for the clamp of an index table: nc_outputs::fin_wait */
  NC_CAUSE_DWELL = 2,
  NC_CAUSE_IN_POSITION = 3,
  NC_CAUSE_PROGRAM_STOP = 4,
  NC_CAUSE_SINGLE_BLOCK = 5,
  NC_CAUSE_FEED_HOLD = 6,   /**< held by it; or it has refused a cycle start and is still on */
  NC_CAUSE_INTERLOCK = 7,
  NC_CAUSE_OVERRIDE_ZERO = 8,
  NC_CAUSE_STARVED = 9,     /**< the feeder has not committed anything further */
  NC_CAUSE_ALARM = 10,
  NC_CAUSE_FEED_ZERO = 11,       /**< F1 to F5 is 0 (M700 operation alarm 104) */
  NC_CAUSE_SPINDLE_STOPPED = 12, /**< synchronous feed without a turning spindle (M700 operation alarm 105) */
  NC_CAUSE_SPINDLE_ANGLE = 13,   /**< a thread waits for its start angle, a synchronous tap for a spindle that stands */
  NC_CAUSE_SPINDLE_FAST = 14,    /**< a thread would need more than the largest cutting feed: it does not begin (M700 6.7.1) */
  NC_CAUSE_SERVO_OFF = 15,       /**< a C axis that is a spindle now is commanded (M700 10.5) */
  NC_CAUSE_TAP_SPINDLE = 16,     /**< in the tapping mode its spindle is to be a C axis (M700 10.6: operation error M01 1026) */
  NC_CAUSE_SPINDLE_UNMEASURED = 17, /**< as SPINDLE_STOPPED, because its speed is not measured */
  NC_CAUSE_NO_LAW = 18,           /**< time-optimal mode: no motion within the limits of the axes was found for what follows; it is looked
                                       for again, and reset gives the program up */
  NC_CAUSE_RESET = 19,            /**< a reset is on its way: the axes come to rest, or the feeder has still to finish what it does. Cycle start is
                                       not taken before IDLE */
  NC_CAUSE_SPINDLE_REVERSED = 20  /**< the spindle turns the other way round than the program has commanded (M03, M04): a thread does not begin */
} nc_stop_cause;

/** Bits of nc_outputs::fin_wait beside those of the groups. */
typedef enum nc_fin_wait_bits {
  NC_FIN_WAIT_UNCLAMP = 0x800 /**< an axis of an index table has to be unclamped or clamped (M700 9.3: T10 FIN WAIT 0800) */
} nc_fin_wait_bits;

/** Who has decided nc_outputs::feed_override. */
typedef enum nc_override_source {
  NC_OVERRIDE_INPUT = 0,  /**< nc_inputs */
  NC_OVERRIDE_PROGRAM = 1 /**< the program: no override acts, by #3004 bit 1 (M700 13.5.10), a thread (6.7.1), the tapping mode (7.11), a skip move (15.2) */
} nc_override_source;

/** What one part system gives out in one cycle. */
typedef struct nc_outputs {
  NC_STRUCT_SIZE(nc_outputs); /**< see NC_STRUCT_SIZE */
  nc_axes command;          /**< commanded machine position for this cycle */
  nc_axes velocity;         /**< mm/s or deg/s, average over the cycle */
  uint32_t output[NC_WORDS]; /**< macro interface outputs, words of #1132..#1135, as programs of this part system have written them */
  uint32_t output_written[NC_WORDS]; /**< bits of them that a block has written in this cycle, to another value or to the same */
  uint8_t state;            /**< nc_run_state */
  uint8_t cause;            /**< nc_stop_cause */
  /* M, S, T, B: the codes stay until the next one; `strobe` bit 0 M, 1 S, 2 T, 3 B is on until FIN. */
  uint8_t strobe;
  uint16_t fin_wait;        /**< groups (bits as in strobe) whose completion is awaited: on until FIN1 has fallen or FIN2 has risen; nc_fin_wait_bits */
  uint32_t unclamp;         /**< bit n: axis n of an index table is to be unclamped, nc_inputs::unclamped answers (M700 9.3) */
  uint32_t m, t, b;
  double s;                 /**< speed that the S command stands for now, r/min: as spindle_rev_min of the selected spindle */
  uint16_t current_limit[NC_MAX_AXES]; /**< percent of the rated current of each drive, 0 = none set (M700 15.6); stays until it is changed */
  double spindle_rev_min[NC_MAX_SPINDLES]; /**< speed that is wanted now: the S code, or what constant surface speed asks for, within the clamp
                                                (G96, G92 S Q); kept while the spindle is not selected, 0 while it is a C axis */
  uint8_t spindle_selected; /**< bit n: spindle n+1 follows the S command */
  uint8_t spindle_encoder;  /**< number of the spindle whose encoder counts, 0 = none */
  uint8_t servo_on;         /**< bit i: axis i, which is a spindle too, is to hold its position */
  uint8_t servo_ready;      /**< bit i: axis i holds its position, and its drive is to follow `command` */
  uint8_t referenced;       /**< bit i: the reference position return of axis i, which is a spindle too, is complete */
  bool rapid;               /**< a rapid move is in execution, or its axes are still on their way */
  bool tapping;             /**< tapping mode G63 (M700 7.11), or a tapping cycle is modal (13.1.1) */
  bool feed_digit_on;       /**< the move in execution has a feed of one digit, `feed_digit` (M700 7.3) */
  uint8_t feed_digit;       /**< 0 to 5 */
  bool distance_zero;       /**< no axis is commanded to move */
  uint32_t at_reference;    /**< bit n: axis n is commanded to its first reference position, in whatever turn */
  uint32_t turning;         /**< bit n: the machine position of axis n counts within one turn, and its limits hold in each (#8213) */
  uint32_t moved_by_hand;   /**< bit n: axis n was moved by hand in a block stop and the program has not moved it since: it does not stand where the program
                                 has left it, and stays there until a block names it. Off with a start that takes the coordinate systems along */
  bool manual_absolute;     /**< manual absolute is in force: the opposite of nc_inputs::manual_absolute_off */
  bool manual_allowed;      /**< nc_inputs::manual acts: no program, or one that is stopped between two blocks */
  bool message;             /**< rising edge: `message_text` has a new operator message */
  uint32_t message_text;    /**< id for nc_text_get() */
  uint32_t message_port;    /**< where it goes: 0 the operator, 1 the external output (POPEN, DPRNT, PCLOS) */
  double feed_mm_min;       /**< actual path speed; behind time constants and S patterns that of the axes */
  double feed_command_mm_min; /**< of the move in execution, without override */
  uint64_t serial;          /**< item in execution: "the block in execution" */
  nc_source source;
  uint32_t modal;           /**< snapshot of the last finished block */
  nc_axes work;             /**< command in the workpiece coordinates of the block in execution; see nc_position_shown() */
  nc_axes distance_to_go;
  uint32_t inputs_refused;  /**< nc_input_bits: what of nc_inputs was no number or out of its range in this cycle */
  double feed_override;     /**< in force now: that of nc_inputs as it acts, or 1 where the program says so (`override_source`) */
  double rapid_override;
  uint8_t override_source;  /**< nc_override_source of feed_override */
  double path_length;       /**< mm travelled since cycle start */
  double run_s;             /**< seconds in state RUNNING since cycle start */
  uint64_t blocks;          /**< blocks finished since cycle start */
  nc_axes joint;            /**< commanded joints, in their units; 0 without nc_config::kinematics */
  nc_axes joint_velocity;   /**< their change in this cycle, unit/s */
  uint8_t joint_faults;     /**< nc_joint_fault_bits of this cycle */
  uint64_t handle_dropped;  /**< bit n: in this cycle a part of the way that the handle of axis n asked for was dropped (NC_MANUAL_HANDLE): the axis
                                 does not end where its wheel says */
  double spindle_turns;     /**< revolutions, forward positive, that the spindle of a synchronous tap (M700 13.1.1) is to have turned since it was taken over;
                                 `spindle_rev_min` of it is then their change, signed */
  uint8_t spindle_synchronous; /**< bit n: spindle n+1 follows `spindle_turns`, standing first. Until R is reached again; behind a reset in the hole
                                    it goes with the axis by hand until the next M or S that turns it */
} nc_outputs;
/**
 * Clear it and set its size. Any thread.
 * @param outputs what is to be cleared; not NULL
 */
static inline void nc_outputs_init(nc_outputs* outputs) {
  const nc_outputs cleared = NC_INIT(nc_outputs);
  *outputs = cleared;
}

/**
 * One servo cycle of every part system. Scan thread.
 * @param control the control
 * @param in  `system_count` entries, the first for part system 0, all of one struct_size
 * @param out as many, all of one struct_size: what the machine is to do in this cycle
 * @return NC_OK; NC_E_ARGUMENT when a pointer is NULL or a struct_size is not valid, or asks for what this library does not know: then no
 *         part system has moved on and `out` is as it was
 */
NC_API nc_status nc_cycle(nc_control* control, const nc_inputs* in, nc_outputs* out) NC_RT;

#ifdef __cplusplus
}
#endif
#endif
