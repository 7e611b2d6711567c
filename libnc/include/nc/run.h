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
#include "nc/inputs.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- offline ------------------------------------------------------------------------------------------------------ */

/**
 * Offline: next item of a part system. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param budget blocks that may be read before the call returns NC_BUDGET without an item (an endless GOTO makes no items)
 * @param item receives the item
 * @return NC_OK: *item is set; NC_WAITING: a sync has not been answered; NC_BUDGET: `budget` blocks were read, call again; NC_ENDED: the end item
 *         has been given; NC_ALARMED: the alarm item and the end item have been given; NC_E_STATE: the program runs online, or a vendor's
 *         function has called; NC_E_ARGUMENT: no such part system, a pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_pull(nc_control* control, unsigned system, uint32_t budget, nc_item* item);

/** What nc_pull_past() passes over. The first members are given by the caller, the others are counted on from what stands in them. */
typedef struct nc_passed {
  NC_STRUCT_SIZE(nc_passed); /**< see NC_STRUCT_SIZE */
  double rapid_mm_min;       /**< given: mm/min that rapid traverse has in `seconds` */
  double spindle_rev_min;    /**< given: r/min, what feeds per revolution are multiplied by */
  uint64_t most_in_row;      /**< given: the most moves without a mark between them; 0 = any number */
  uint64_t moves_in_row;     /**< moves since the last mark that was passed: the caller clears it where a block begins */
  uint64_t moves;            /**< number of moves */
  uint64_t marks;            /**< number of marks inside a block since the last move; a move clears it */
  double length;             /**< of the paths, mm or deg, as nc_move::length */
  double seconds;            /**< s: what the moves take at their programmed feeds, without acceleration */
  nc_axes machine;           /**< end of the last move, machine coordinates */
  nc_axes work;              /**< the same in the active workpiece coordinates */
  nc_source source;          /**< of the last item that was passed */
} nc_passed;
/**
 * Clear it and set its size. Any thread.
 * @param passed what is to be cleared; not NULL
 */
static inline void nc_passed_init(nc_passed* passed) {
  const nc_passed cleared = NC_INIT(nc_passed);
  *passed = cleared;
}

/**
 * Offline: as nc_pull(), for whoever only wants to know whether a program runs to its end, how far and how long: moves are passed over and counted, and so
 * are the marks inside a block behind such a move. Every other item is given, and a skip move, whose end only the world knows. While the signal of
 * a macro interrupt is on, no move is passed; one that comes on behind such a move acts at the end of its block. The two functions may be called in turn, but
 * nc_move_point() and its like have no move behind one that was passed. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param budget blocks that may be read before the call returns NC_BUDGET without an item
 * @param passed what has been passed over, also where no item is given
 * @param item receives the item
 * @return as nc_pull(); NC_BUDGET also where `most_in_row` moves have been passed without a mark between them
 */
NC_API nc_status nc_pull_past(nc_control* control, unsigned system, uint32_t budget, nc_passed* passed, nc_item* item);

/**
 * Offline: a point of the move that nc_pull() gave last. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param share the part of the move's length that lies before the point, 0 to 1
 * @param machine receives the point, machine coordinates, mm or deg
 * @return NC_OK; NC_E_STATE: no move was given last, or the program runs online; NC_E_ARGUMENT: no such part system, `share` is out of range, or a
 *         pointer is NULL
 */
NC_API nc_status nc_move_point(const nc_control* control, unsigned system, double share, nc_axes* machine);

/**
 * Offline: the zero point of the workpiece coordinates of the move that nc_pull() gave last, shifted by the tool length that the move applies. A
 * point of the move minus this zero point is where the tip of the tool is on the workpiece; radius compensation remains in the path. Feeder
 * thread.
 * @param control the control
 * @param system part system, from 0
 * @param zero receives the zero point, machine coordinates, mm or deg
 * @return as nc_move_point()
 */
NC_API nc_status nc_move_zero(const nc_control* control, unsigned system, nc_axes* zero);

/** On which side of its programmed path the tool goes. */
typedef enum nc_side {
  NC_SIDE_NONE = 0,  /**< no compensation is in force. A move that leads back to the programmed path has no side any more, nor has one without an amount */
  NC_SIDE_LEFT = 1,  /**< left of the direction of travel: G41, or G42 with a negative amount */
  NC_SIDE_RIGHT = 2, /**< right of it */
  NC_SIDE_SPACE = 3  /**< a vector in space is in force, which leads to no side: three-dimensional radius compensation, a length along the tool axis */
} nc_side;

/**
 * Offline: on which side of its programmed path the tool goes in the move that nc_pull() gave last, by the codes in force in its block. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param side receives the side
 * @param plane_axis receives the indices of the first and second axis of the plane in which the tool goes to the left or to the right; as they were otherwise
 * @return as nc_move_point()
 */
NC_API nc_status nc_move_side(const nc_control* control, unsigned system, nc_side* side, uint8_t plane_axis[2]);

/**
 * Offline: answer the open sync of a part system. After NC_SYNC_SKIP the interpreter goes on from world->machine. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param world the state of the machine when everything before the sync had been executed; copied
 * @return NC_OK; NC_E_STATE: no sync is open, or the program runs online, where the scan answers; NC_E_ARGUMENT: no such part system, `world` is
 *         NULL, a number in it is not finite, or its struct_size is not valid
 */
NC_API nc_status nc_answer(nc_control* control, unsigned system, const nc_world* world);

/**
 * Offline: give up what was read after the mark `serial` and read it again: switches, offsets and variables that the host has changed since
 * then act from the next block on. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param serial serial of one of the last `look_ahead` marks that end a block (nc_mark::report); 0 = the start of the program
 * @return NC_OK; NC_E_NOT_FOUND: no such mark, too old, or in a contour whose blocks depend on one before it; NC_E_STATE: online; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_rewind(nc_control* control, unsigned system, uint64_t serial);

/**
 * Online, at rest in a block stop or a hold: give up what was read beyond the block in execution and read it again (M700 4.2
 * "recalculation request"). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @return NC_OK: it is done, or no program runs; NC_ALARMED: the blocks cannot be read again, which has stopped the program with an alarm;
 *         NC_WAITING: the scan has not agreed yet, which it does only at rest (call again); NC_E_STATE: a vendor's function has called; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_recalculate(nc_control* control, unsigned system);

/**
 * Offline: set the level of the macro interrupt signal UIT (M700 13.12); call it whenever the level changes. The item that was pulled last counts
 * as not executed yet. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param on the level
 * @param take_back receives whether the item that was pulled last must not be executed any more, because the interrupt (type 1) has come before it
 * @return NC_OK; NC_E_STATE: the program runs online, where the signal comes with nc_inputs; NC_E_ARGUMENT: no such part system, or a
 *         pointer is NULL
 */
NC_API nc_status nc_interrupt_signal(nc_control* control, unsigned system, bool on, bool* take_back);

/**
 * Stop the program: modes are as after reset (M700 3.7 "reset 2"), and the program is at its beginning again. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @return NC_OK; NC_E_STATE: the program runs online, where nc_inputs::reset stops it; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_reset(nc_control* control, unsigned system);

/* ---- online: feeder ----------------------------------------------------------------------------------------------- */

/**
 * Online: read, compensate, plan and commit blocks ahead of the machine, for every part system. Feeder thread.
 *
 * A part system works in rounds: blocks are read, 1024 at most, and then what is committed is planned. The budget says where a call ends amid
 * a round; the next call goes on there. What the machine does depends on how soon the rounds come, and on nothing else: what is planned is the
 * same to the last bit, whatever the budget is. Until a plan is ready the scan has the one before, which ends at rest. A stop (hold, interlock,
 * reset, alarm), another override and single block are planned for before anything else, by the first call behind the scan that has seen them.
 *
 * A unit of the budget is one block that is read, or planning of 20,000 instructions of a processor at most in the time-optimal mode; no step
 * of planning lines, arcs and rests takes more than 200,000; of curves (NURBS, splines) they were not counted. With the trapezoid planning is not counted: each call plans once, whatever its budget is.
 * @param control the control
 * @param budget units of this call for each part system
 * @return the first of these that is true of any part system: NC_OK: a round has come to its end in which something was committed; NC_ALARMED: its
 *         program is committed up to an alarm; NC_BUDGET: there is more to be done now, call again; NC_WAITING: nothing can be done until the scan
 *         goes on. NC_ENDED: every program is committed to its end. NC_E_STATE: a vendor's function has called; NC_E_ARGUMENT: `control` is NULL
 */
NC_API nc_status nc_feed(nc_control* control, uint32_t budget);

/** An item that the scan has executed to its end. Events come in the order of execution. */
typedef struct nc_event {
  NC_STRUCT_SIZE(nc_event); /**< see NC_STRUCT_SIZE */
  uint64_t serial;  /**< nc_item::serial of the item */
  nc_source source; /**< nc_item::source of the item */
  uint8_t kind;    /**< nc_item_kind of the item */
  bool again;      /**< nc_mark::again of a mark: its block holds the M99 that begins the main program again (M700 13.3.1) */
  nc_axes machine; /**< commanded machine position at that moment */
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
 * Next executed item. At least the last `look_ahead` events are kept; when events are not fetched in time the oldest are dropped and counted.
 * Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param event receives the event
 * @param dropped receives how many events of this part system have been dropped in all since the control was created. May be NULL.
 * @return NC_OK; NC_E_NOT_FOUND: nothing further has been executed; NC_E_ARGUMENT: no such part system, `event` is NULL, or its
 *         struct_size is not valid
 */
NC_API nc_status nc_event_poll(nc_control* control, unsigned system, nc_event* event, uint64_t* dropped);

/**
 * The block at which reading waits, because the block needs a value that exists only when everything before it has been executed (a position, an
 * input). From it a simulated machine knows which value it has to give before the scan gets there. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param source receives where the block stands
 * @param main_line receives the line of the main program to which the block belongs, as nc_main_line_get() gives it
 * @return NC_OK; NC_E_NOT_FOUND: reading does not stand at such a block; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_sync_get(const nc_control* control, unsigned system, nc_source* source, uint32_t* main_line);

/**
 * The line of the main program to which a block belongs: the line of the block itself, or that of the block in the main program which has called
 * the program in which it stands. It is known only for the item that nc_pull() has given last, and in an nc_commit_watch for the item that it is
 * given. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param source nc_item::source of that item
 * @param main_line receives the line, from 1; 0: it is not known
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_main_line_get(const nc_control* control, unsigned system, const nc_source* source, uint32_t* main_line);

/**
 * Called by nc_feed() with each item before it is committed, in the order of the stream, so that a simulated machine can prepare what it has to do
 * when it gets there. When blocks that were read ahead are read again (recalculation, macro interrupt, reset) the serials go back: all items given
 * before with the repeated serial or a higher one are void. Functions that change the program or its tables must not be called in it. Feeder
 * thread.
 * @param user what nc_commit_watch_set() was given
 * @param item the item as nc_pull() would give it; valid until the function returns
 * @return true: the item is committed; false: neither this item nor any behind it is committed now, and the next nc_feed() asks again
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

/** Run state of a part system. */
typedef enum nc_run_state {
  NC_STATE_IDLE = 0,    /**< no program started, or ended, or reset */
  NC_STATE_RUNNING = 1,
  NC_STATE_HOLD = 2,    /**< feed hold: at rest on the path, or decelerating to rest */
  NC_STATE_STOPPED = 3, /**< block stop: single block, M00, M01; cycle start continues */
  NC_STATE_ALARM = 4,
  NC_STATE_MANUAL = 5
} nc_run_state;

/** Why nothing moves although a program runs. */
typedef enum nc_stop_cause {
  NC_CAUSE_NONE = 0,
  NC_CAUSE_FIN = 1,         /**< FIN of M, S, T or B, or the clamp of an index table is waited for: nc_outputs::fin_wait says which */
  NC_CAUSE_DWELL = 2,
  NC_CAUSE_IN_POSITION = 3,
  NC_CAUSE_PROGRAM_STOP = 4,
  NC_CAUSE_SINGLE_BLOCK = 5,
  NC_CAUSE_FEED_HOLD = 6,   /**< feed hold has stopped the program, or it has refused a cycle start and is still on */
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
  NC_CAUSE_SPINDLE_REVERSED = 20, /**< the spindle turns the other way round than the program has commanded (M03, M04): a thread does not begin */
  NC_CAUSE_TAP_IN_HOLE = 21,      /**< a cycle start was refused because a synchronous tap stands in its hole: it is drawn out first, by the signal
                                       or by hand (nc_inputs::tap_retract). Not behind NC-TAP in such an attempt, since its spindle does not follow */
  NC_CAUSE_MDI_ENDED = 22,        /**< the blocks of MDI that interrupt a program have been executed: cycle start goes on with the program */
  NC_CAUSE_MANUAL_FEED_ZERO = 23, /**< dry run, and the manual feed rate is 0 */
  NC_CAUSE_RESTART = 24           /**< the program is begun inside (nc/restart.h), and stands at the place: cycle start goes on. It is refused while
                                       nc_outputs::restart_axes is not 0 */
} nc_stop_cause;

/** Bits of nc_outputs::fin_wait in addition to those of M, S, T and B. */
typedef enum nc_fin_wait_bits {
  NC_FIN_WAIT_UNCLAMP = 0x800 /**< an axis of an index table has to be unclamped or clamped (M700 9.3: T10 FIN WAIT 0800) */
} nc_fin_wait_bits;

/** What nc_outputs::feed_override comes from. */
typedef enum nc_override_source {
  NC_OVERRIDE_INPUT = 0,  /**< nc_inputs */
  NC_OVERRIDE_PROGRAM = 1 /**< the program has switched overrides off: by #3004 bit 1 (M700 13.5.10), a thread (6.7.1), the tapping mode (7.11) or a skip
                               move (15.2) */
} nc_override_source;

/** Bits of nc_outputs::tool_life. */
typedef enum nc_tool_life_bits {
  NC_TOOL_LIFE_ENDED = 1, /**< the life of the tool in the spindle has ended */
  NC_TOOL_GROUP_ENDED = 2 /**< and so have those of all tools of its group */
} nc_tool_life_bits;

/** What one part system gives out in one cycle. */
typedef struct nc_outputs {
  NC_STRUCT_SIZE(nc_outputs); /**< see NC_STRUCT_SIZE */
  nc_axes command;          /**< commanded machine position for this cycle, mm or deg */
  nc_axes velocity;         /**< mm/s or deg/s, average over the cycle */
  uint32_t output[NC_WORDS]; /**< macro interface outputs, words of #1132..#1135, as programs of this part system have written them */
  uint32_t output_written[NC_WORDS]; /**< bits of `output` that a block has written in this cycle, whether their values have changed or not */
  uint8_t state;            /**< nc_run_state */
  uint8_t cause;            /**< nc_stop_cause */
  uint8_t strobe;           /**< bit 0: a new M, bit 1: S, bit 2: T, bit 3: B; each is on until FIN1 or FIN2 rises */
  uint16_t fin_wait;        /**< M, S, T, B (bits as in `strobe`) whose completion is waited for: on until FIN1 has fallen or FIN2 has risen; and
                                 nc_fin_wait_bits */
  uint32_t unclamp;         /**< bit n: axis n of an index table is to be unclamped; nc_inputs::unclamped is the answer (M700 9.3) */
  uint32_t m, t, b;         /**< numbers of the last M, T and second auxiliary function; each stays until the next one */
  double s;                 /**< spindle speed that the S command means now, r/min: spindle_rev_min of the selected spindle; while no spindle is
                                 selected, the S code */
  uint16_t current_limit[NC_MAX_AXES]; /**< percent of the rated current of each drive, 0 = none set (M700 15.6); stays until it is changed */
  double spindle_rev_min[NC_MAX_SPINDLES]; /**< commanded speed of each spindle, r/min: the S code, or the speed that gives the constant surface speed (G96),
                                                within the clamp of G92 S Q; it stays while the spindle is not selected, and is 0 while it is a C axis */
  uint8_t spindle_selected; /**< bit n: spindle n+1 follows the S command */
  uint8_t spindle_encoder;  /**< number (from 1) of the spindle whose encoder is used, 0 = none */
  uint8_t servo_on;         /**< bit i: axis i, which is a spindle too, is to hold its position */
  uint8_t servo_ready;      /**< bit i: axis i holds its position, and its drive is to follow `command` */
  uint8_t referenced;       /**< bit i: the reference position return of axis i, which is a spindle too, is complete */
  bool rapid;               /**< a rapid move is in execution, or its axes are still on their way */
  bool tapping;             /**< tapping mode G63 (M700 7.11), or a tapping cycle is modal (13.1.1) */
  bool feed_digit_on;       /**< the move in execution has a feed of one digit, `feed_digit` (M700 7.3) */
  uint8_t feed_digit;       /**< 0 to 5 */
  bool distance_zero;       /**< no axis is commanded to move in this cycle */
  uint32_t at_reference;    /**< bit n: axis n is commanded to its first reference position; where `turning` is set, in any turn */
  uint32_t turning;         /**< bit n: the machine position of axis n is counted within one turn, and its stroke limits hold in each turn (#8213) */
  uint32_t moved_by_hand;   /**< bit n: axis n was moved by hand in a block stop, and the program has not moved it since: it does not stand where the
                                 program has left it, and stays there until a block names it. The bit goes off at a start that moves the coordinate
                                 systems along with the axis */
  bool manual_absolute;     /**< manual absolute is in force: the opposite of nc_inputs::manual_absolute_off */
  bool manual_allowed;      /**< nc_inputs::manual acts: there is no program, it is stopped between two blocks, or it stands in a feed hold
                                 (`restart_axes`), not in a thread or between R and R of a tap */
  bool message;             /**< on in the cycle that gives out a message: `message_text` and `message_port` are new */
  uint32_t message_text;    /**< id of the message for nc_text_get() */
  uint32_t message_port;    /**< where the message goes: 0 to the operator, 1 to the external output (POPEN, DPRNT, PCLOS) */
  double feed_mm_min;       /**< actual path speed, mm/min; where time constants or S patterns act, the speed of the axes behind them */
  double feed_command_mm_min; /**< commanded feed of the move in execution, mm/min, without override */
  uint64_t serial;          /**< serial of the item in execution: it tells "the block in execution" */
  nc_source source;         /**< where the block in execution stands */
  uint32_t modal;           /**< id of the modal snapshot of the last finished block, see nc_modal_get() */
  nc_axes work;             /**< commanded position in the workpiece coordinates of the block in execution, mm or deg; see nc_position_shown() */
  nc_axes distance_to_go;   /**< way of each axis to the end of the move in execution, mm or deg */
  uint32_t inputs_refused;  /**< nc_input_bits: the inputs that were refused in this cycle, because they were not finite or out of range */
  double feed_override;     /**< feed override in force, 1 = 100 %: the one of nc_inputs, or 1 while the program has switched it off
                                 (`override_source`) */
  double rapid_override;    /**< rapid override in force, 1 = 100 % */
  uint8_t override_source;  /**< nc_override_source of feed_override */
  double path_length;       /**< mm travelled since cycle start */
  double run_s;             /**< seconds in state RUNNING since cycle start */
  uint64_t blocks;          /**< blocks of the program that are finished, since it was begun: in a program that was begun inside (nc/restart.h) with those before
                                 the place. Blocks of MDI in a block stop and those of interrupt programs do not count */
  nc_axes joint;            /**< commanded joints, in their units; 0 without nc_config::kinematics */
  nc_axes joint_velocity;   /**< change of the joints in this cycle, unit/s */
  uint8_t joint_faults;     /**< nc_joint_fault_bits of this cycle */
  uint64_t handle_dropped;  /**< bit n: in this cycle a part of the way that the handle of axis n asked for was dropped (NC_MANUAL_HANDLE): the axis
                                 does not end where its wheel says */
  double spindle_turns;     /**< revolutions, forward positive, that the spindle of a synchronous tap (M700 13.1.1) is to have turned since it was taken over;
                                 `spindle_rev_min` of it is then their change, signed */
  uint8_t spindle_synchronous; /**< bit n: spindle n+1 follows `spindle_turns`, standing first. Until R is reached again; behind a reset in the hole
                                    it goes with the axis by hand until that is moved on outside, a program begins, or an M or S that turns it comes */
  bool tap_retract_possible; /**< a tap was given up in its hole and stands there: nc_inputs::tap_retract draws it out, by hand it turns with its axis */
  uint8_t tool_life;        /**< nc_tool_life_bits of the tool in the spindle */
  uint32_t tool_group;      /**< its group of tool life management, 0 = none */
  uint32_t tap_holds;       /**< bit n: axis n is not moved by hand, because a tap that was given up stands in its hole and would break, or tear the hole.
                                 The axis of the tap is free, and the way out; when its spindle does not follow, that is an alarm, which ends this */
  bool followed;            /**< in this cycle `command` was taken from nc_inputs::actual (nc_inputs::follow_up) */
  uint32_t restart_axes;    /**< bit n: cycle start is refused, because axis n is not where the program goes on. One that is begun inside (nc/restart.h) waits for
                                 it, or it was moved by hand where a feed hold has stopped the path, which goes on from there: amid a block, or behind a thread */
  double tool_length_added; /**< what nc_inputs::tool_length_handle has added to the length of the number in force, mm, also what counts only from the next block on. 0
                                 again with another number, at the end of the compensation (G49, G43, G44, number 0), with the end of the program and a reset; the
                                 table of tool offsets is not changed */
  bool tool_length_dropped; /**< in this cycle a way of nc_inputs::tool_length_handle was dropped: it did not count (see there), the amount would have been out of the
                                 range of an offset, or its number was changed before it could act */
  nc_axes return_place;     /**< machine position to which NC_MANUAL_RETURN leads each axis: where a program that is stopped goes on, or where it has left the axes in
                                 a block stop. `command` where there is no such place */
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
 * The synchronous tap that stands in a hole, or could (M700 13.1.1): what has to outlast a power cut so that it can be drawn out afterwards. It is there
 * from the first stroke of a hole until the tap is at R again, and behind a reset in the hole until the spindle is commanded again.
 */
typedef struct nc_tap {
  NC_STRUCT_SIZE(nc_tap);   /**< see NC_STRUCT_SIZE */
  uint8_t axis;             /**< that the tap is moved by, from 1; 0 = there is no tap */
  double entry;             /**< machine position of R, mm: here it is out of the hole */
  double turns_per_mm;      /**< revolutions of the spindle by the way of the axis, forward positive; not 0 */
  double speed;             /**< of the axis, mm/s, with the sign of the way into the hole; not 0 */
  double acceleration;      /**< highest of the axis that the spindle follows, mm/s^2; 0 = that of the axis */
  uint8_t spindles;         /**< bit n: spindle n+1 turns with it (M700 10.6), whatever is selected meanwhile; 0 = not known: those that are selected as it is
                                 drawn out */
  uint8_t encoder;          /**< number (from 1) of the spindle whose angle its axis follows; 0 = none, or `spindles` is 0 */
} nc_tap;

/**
 * Read the tap of a part system as the scan has left it. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param tap receives it; its `axis` is 0 where there is none
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `tap` is NULL or has no valid struct_size
 */
NC_API nc_status nc_tap_get(const nc_control* control, unsigned system, nc_tap* tap);

/**
 * Give back what nc_tap_get() had read before the power was cut: nc_inputs::tap_retract can then draw the tap out. To be called before the first
 * nc_cycle(). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param tap what was read
 * @return NC_OK; NC_E_ARGUMENT: no such part system, axis or spindle, or a number out of its range; NC_E_STATE: the scan runs already
 */
NC_API nc_status nc_tap_set(nc_control* control, unsigned system, const nc_tap* tap);

/**
 * One servo cycle of every part system. Scan thread.
 * @param control the control
 * @param in  `system_count` elements, the first for part system 0, all of the same struct_size
 * @param out receives `system_count` elements, all of the same struct_size: what the machine is to do in this cycle
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL, a struct_size is not valid, or `in` has bytes other than 0 behind what this library knows: then
 *         no part system has moved on, and `out` is as it was
 */
NC_API nc_status nc_cycle(nc_control* control, const nc_inputs* in, nc_outputs* out) NC_RT;

#ifdef __cplusplus
}
#endif
#endif
