/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file item.h
 * The item stream as a sink sees it: everything that a program causes, as items in the order of execution, each with a serial number.
 *
 * `trace`, `time`, `plot`, the runtime and a vendor's own loop are sinks of this one stream. Offline sinks pull items with
 * nc_pull(); online the control takes them itself in nc_feed() and executes them in nc_cycle(), and nc_event_poll() reports every serial
 * that has been executed. Offline and online the serials and the end points are the same.
 */
#ifndef NC_ITEM_H
#define NC_ITEM_H

#include "nc/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Kinds of item. */
typedef enum nc_item_kind {
  NC_ITEM_MOVE = 0,   /**< motion with non-zero length */
  NC_ITEM_ACTION = 1, /**< something that is given out to the machine or the operator at this point and not earlier */
  NC_ITEM_GATE = 2,   /**< wait here until a condition holds */
  NC_ITEM_SYNC = 3,   /**< the interpreter needs a value that exists only when everything before has been executed: answer it with nc_answer() */
  NC_ITEM_MARK = 4,   /**< a block has ended */
  NC_ITEM_ALARM = 5,  /**< the program stops here */
  NC_ITEM_END = 6     /**< the last item */
} nc_item_kind;

/** What a move is called in a trace. */
typedef enum nc_move_kind {
  NC_MOVE_RAPID = 0,
  NC_MOVE_LINE = 1,
  NC_MOVE_ARC = 2,
  NC_MOVE_HELIX = 3,
  NC_MOVE_SKIP = 4,  /**< G31: a line that ends where the skip signal comes */
  NC_MOVE_THREAD = 5,
  NC_MOVE_TAP = 6,
  NC_MOVE_SPIRAL = 7,
  NC_MOVE_EXPONENTIAL = 8,
  NC_MOVE_NURBS = 9,
  NC_MOVE_SPLINE = 10
} nc_move_kind;

/** Plane of a circular move. */
typedef enum nc_plane { NC_PLANE_XY = 0, NC_PLANE_ZX = 1, NC_PLANE_YZ = 2, NC_PLANE_NONE = 3 } nc_plane;

/** Kinds of action. */
typedef enum nc_action_kind {
  NC_ACTION_M = 0,       /**< auxiliary function; `value` is its number */
  NC_ACTION_S = 1,       /**< spindle speed; `value` in r/min (m/min in G96) */
  NC_ACTION_T = 2,       /**< tool; `value` is its number */
  NC_ACTION_B = 3,       /**< second auxiliary function; `value` is its number, `letter` its address */
  NC_ACTION_OUTPUT = 4,  /**< macro interface output: in word `index` (0..3) the bits of `mask` get the values in `bits` (M700 13.5.5) */
  NC_ACTION_MESSAGE = 5, /**< a message of #3006 or DPRNT: `text` is its text, `index` the port (0 = message to the operator) */
  NC_ACTION_CONTROL = 6, /**< `index` is an nc_control_index, which says what `value` means */
  NC_ACTION_CURRENT_LIMIT = 7 /**< current limit of axis `index`: `value` is in percent of the rated current (M700 15.6) */
} nc_action_kind;

/** nc_action::index of an NC_ACTION_CONTROL: what the action is about. */
typedef enum nc_control_index {
  NC_CONTROL_SUPPRESS = 0,       /**< `value`: nc_suppress_bits (M700 13.5.9, #3003) */
  NC_CONTROL_DISABLE = 1,        /**< `value`: nc_disable_bits (M700 13.5.10, #3004) */
  NC_CONTROL_TAPPING = 2,        /**< tapping: `value` nc_tapping_bits, 0 = none (M700 7.11, 13.1.1) */
  NC_CONTROL_SURFACE_RADIUS = 3, /**< constant surface speed: the radius at the present coordinate of the axis of `bits` is `value` mm, and its coordinates
                                      are diameters */
  NC_CONTROL_SURFACE_SPEED = 4,  /**< constant surface speed (M700 10.3): `value` m/min, `bits` bit n = by axis n, 0 = it has ended */
  NC_CONTROL_SPINDLE_CLAMP = 5,  /**< clamp of the selected spindles (M700 10.4): `bits` S, `mask` Q as programmed, r/min; `value` nc_clamp_bits */
  NC_CONTROL_TOOL_LIFE = 6,      /**< a tool has come into the spindle: `value` its place in the table of tool life, 0 = its life is not managed;
                                      `bits` the number of the tool that is registered there */
  NC_CONTROL_INTERRUPT = 7       /**< macro interrupt: `value` nc_interrupt_bits */
} nc_control_index;

/** What the program has suppressed, in `value` of NC_CONTROL_SUPPRESS: bits. */
typedef enum nc_suppress_bits {
  NC_SUPPRESS_SINGLE_BLOCK = 1, /**< no stop of single block */
  NC_SUPPRESS_FIN = 2           /**< FIN is not awaited */
} nc_suppress_bits;

/** What the program has disabled, in `value` of NC_CONTROL_DISABLE: bits. */
typedef enum nc_disable_bits {
  NC_DISABLE_FEED_HOLD = 1, /**< no feed hold */
  NC_DISABLE_OVERRIDE = 2,  /**< no override */
  NC_DISABLE_EXACT_STOP = 4 /**< no exact stop */
} nc_disable_bits;

/** What of tapping is in force, in `value` of NC_CONTROL_TAPPING. */
typedef enum nc_tapping_bits {
  NC_TAPPING_MODE = 1,   /**< the mode of M700 7.11: no feed hold, no stop of single block */
  NC_TAPPING_CYCLE = 2,  /**< a tapping cycle is modal (13.1.1) */
  NC_TAPPING_STROKES = 4, /**< between R and R again: a feed hold acts behind that */
  NC_TAPPING_SYNCHRONOUS = 8 /**< and the path turns the spindle: nc_outputs::spindle_synchronous */
} nc_tapping_bits;

/** How speeds are clamped (M700 10.4): bits. */
typedef enum nc_clamp_bits {
  NC_CLAMP_ALWAYS = 1,    /**< the clamp acts in G97, too, and not only in G96 */
  NC_CLAMP_OVER_RESET = 2, /**< a reset does not end the clamp */
  NC_CLAMP_S = 4,         /**< S has been commanded; otherwise a spindle keeps the S that it had */
  NC_CLAMP_Q = 8          /**< Q has been commanded; otherwise a spindle keeps the Q that it had */
} nc_clamp_bits;

/** State of the macro interrupt (M700 13.12): bits. */
typedef enum nc_interrupt_bits {
  NC_INTERRUPT_ENABLED = 1,   /**< between M96 and M97 */
  NC_INTERRUPT_BY_LEVEL = 2,  /**< the signal is accepted as long as it is on; otherwise only when it rises (#1112) */
  NC_INTERRUPT_IN_SERVICE = 4, /**< the interrupt program runs: signals are ignored */
  NC_INTERRUPT_AT_ONCE = 8     /**< type 1 (#1113 = 0): a block is interrupted in its middle; otherwise at its end */
} nc_interrupt_bits;

/** Kinds of gate. */
typedef enum nc_gate_kind {
  NC_GATE_FIN = 0,            /**< the M, S, T or B action just before is complete */
  NC_GATE_DWELL_SECONDS = 1,  /**< `value` seconds have passed */
  NC_GATE_DWELL_TURNS = 2,    /**< the spindle has made `value` revolutions */
  NC_GATE_IN_POSITION = 3,    /**< all axes are in position */
  NC_GATE_STOP = 4,           /**< program stop M00: cycle start continues */
  NC_GATE_OPTIONAL_STOP = 5   /**< M01: acts as M00 while the optional stop switch is on, otherwise nothing is waited for */
} nc_gate_kind;

/** What a sync waits for; bits of nc_item::sync.what. */
typedef enum nc_sync_what {
  NC_SYNC_POSITION = 1, /**< machine, workpiece or skip position */
  NC_SYNC_INPUT = 2,    /**< macro interface inputs, or the angles of the tool */
  NC_SYNC_CLOCK = 4,    /**< date, time, integrated time */
  NC_SYNC_SKIP = 8,     /**< the position at which a G31 move has ended */
  NC_SYNC_MODAL = 16,   /**< modal state in execution (#4200s) */
  NC_SYNC_STOPPED = 32, /**< no value: only that everything before has been executed */
  NC_SYNC_SHARED = 64   /**< what several part systems share: a common variable, tool data. The control holds these itself, so no member of the answer is
                             used */
} nc_sync_what;

/** A text that goes with an item; NUL-terminated, cut at NC_MAX_TEXT - 1 bytes. */
typedef struct nc_text {
  char s[NC_MAX_TEXT]; /**< the text, or the bytes of a BPRNT line */
  uint32_t size; /**< number of bytes of a BPRNT line, which may contain zeros; 0 = the text ends at its NUL */
} nc_text;

/** Payload of a move. `work` and `center` are in the active workpiece coordinates, without tool compensation;
 *  members named `machine` are machine coordinates with every compensation. Positions are in mm, or in deg on rotary axes. */
typedef struct nc_move {
  nc_axes work;             /**< programmed end point */
  nc_axes machine_start;    /**< start point */
  nc_axes machine;          /**< end point */
  double center[3];         /**< circular: programmed centre, mm or deg; element k is the coordinate on axis plane_axis[k]. The third element counts only where
                                 `center_axes` is 3 */
  double machine_center[3]; /**< circular: centre of the machine path, mm or deg, on the same axes */
  double radius;            /**< circular: radius of the machine path at its start, mm */
  double sweep_deg;         /**< circular: angle of the machine path about the plane normal, deg, counter-clockwise positive */
  double feed_mm_min;       /**< feed that the block commands, mm/min; 0 for rapid */
  double feed_mm_rev;       /**< feed per revolution, mm/rev; 0 when the feed is per minute; of a thread its lead along the axis that goes furthest */
  double length;            /**< path length, mm (deg when only rotary axes move) */
  uint32_t turns;           /**< circular: full turns in addition to the arc up to its end point */
  uint8_t kind;             /**< nc_move_kind */
  uint8_t plane;            /**< nc_plane; NC_PLANE_NONE unless circular */
  uint8_t center_axes;      /**< 2 for a circular move in a plane, 3 for an arc in space, else 0 */
  uint8_t plane_axis[3];    /**< circular: index of the plane's first and second axis; for an arc in space of its three axes */
  bool ccw;                 /**< circular: the machine path runs counter-clockwise */
  bool exact_stop;          /**< the axes come to rest at the end of the move */
  bool curved;              /**< the path of the axes is neither a line nor a circle of theirs: nc_move_point() gives its points */
  uint8_t skip_mask;        /**< skip: the signals that end the move, bit n = signal n+1 */
  uint8_t index_axes;       /**< bit n: the move turns axis n, an index table, which is unclamped for it (M700 9.3) */
  bool skip_away;           /**< skip: the move ends where all signals of skip_mask that it listens to are off (a probe that leaves the work) */
} nc_move;

/** Payload of an action. */
typedef struct nc_action {
  double value;        /**< what it means, and its unit, is said at each nc_action_kind and nc_control_index */
  uint32_t mask, bits; /**< NC_ACTION_OUTPUT and some of NC_ACTION_CONTROL */
  uint32_t index;      /**< what it means is said at each nc_action_kind */
  uint32_t text;       /**< NC_ACTION_MESSAGE: id for nc_text_get() */
  uint8_t kind;        /**< nc_action_kind */
  char letter;         /**< address as programmed; 0 where the language spells it with more than a letter */
} nc_action;

/** Payload of a gate. */
typedef struct nc_gate {
  double value;  /**< dwell: seconds or revolutions, as nc_gate_kind says; in position: the width that the block gives, mm or deg, 0 = that of each
                      axis */
  uint8_t kind; /**< nc_gate_kind */
  bool announce; /**< a dwell that is programmed with its time, or made by a fixed cycle: a trace shows it as an event */
  uint8_t skip_mask; /**< dwell: skip signals that end it, bit n = signal n+1 (M700 15.3, 15.4) */
} nc_gate;

/** The modal state that a block leaves behind. */
typedef struct nc_modal {
  NC_STRUCT_SIZE(nc_modal); /**< see NC_STRUCT_SIZE */
  int16_t code[NC_GROUPS]; /**< active G code of each group, times 10 (G54.1 = 541, G00 = 0); -1 = group not used */
  double feed, spindle; /**< F and S as programmed: the active G codes give their units */
  uint32_t tool, d, h, m, n, o, b; /**< the last T, D, H, M, N and O, and the last second auxiliary function */
} nc_modal;
/**
 * Clear it and set its size. Any thread.
 * @param modal what is to be cleared; not NULL
 */
static inline void nc_modal_init(nc_modal* modal) {
  const nc_modal cleared = NC_INIT(nc_modal);
  *modal = cleared;
}

/** Payload of a mark: the end of a block. */
typedef struct nc_mark {
  nc_axes work;   /**< position at the end of the block, active workpiece coordinates */
  uint32_t modal; /**< id of the modal snapshot, see nc_modal_get() */
  bool stop;      /**< single block may stop here */
  bool report;    /**< true: a whole block has ended; false: the mark is a place inside a fixed cycle where single block may stop */
  bool again;     /**< the block holds the M99 that begins the main program again (M700 13.3.1) */
} nc_mark;

/** Payload of an alarm. */
typedef struct nc_alarm {
  NC_STRUCT_SIZE(nc_alarm); /**< see NC_STRUCT_SIZE */
  char code[16];    /**< as the manual prints it, without blanks: "P33", "F_82112" */
  char message[64]; /**< the manual's short text, or the host's (nc_config::alarm_text) */
  nc_text detail;   /**< what in this block caused the alarm, in words for the person at the machine */
  int8_t axis;      /**< index of the axis that the alarm is about, -1 = none */
  nc_source source; /**< block that caused the alarm */
} nc_alarm;
/**
 * Clear it and set its size. Any thread.
 * @param alarm what is to be cleared; not NULL
 */
static inline void nc_alarm_init(nc_alarm* alarm) {
  const nc_alarm cleared = NC_INIT(nc_alarm);
  *alarm = cleared;
}

/** One item of the stream, as sinks get it. */
typedef struct nc_item {
  NC_STRUCT_SIZE(nc_item); /**< see NC_STRUCT_SIZE */
  uint64_t serial;  /**< strictly increasing, without gaps within a run */
  nc_source source; /**< block that has caused the item */
  uint8_t kind;     /**< nc_item_kind */
  union {
    nc_move move;     /**< of NC_ITEM_MOVE */
    nc_action action; /**< of NC_ITEM_ACTION */
    nc_gate gate;     /**< of NC_ITEM_GATE */
    struct {
      uint32_t what; /**< nc_sync_what bits */
    } sync; /**< of NC_ITEM_SYNC */
    nc_mark mark;     /**< of NC_ITEM_MARK */
    struct {
      bool ok;          /**< true: the program has ended by M02, M30 or another end that the dialect allows; false: by an alarm */
      nc_axes work;     /**< position at the end, active workpiece coordinates */
      uint32_t modal;   /**< id of the modal snapshot, see nc_modal_get() */
    } end; /**< of NC_ITEM_END */
  } u; /**< the payload that `kind` says; NC_ITEM_ALARM has none: nc_alarm_get() */
} nc_item;
/**
 * Clear it and set its size. Any thread.
 * @param item what is to be cleared; not NULL
 */
static inline void nc_item_init(nc_item* item) {
  const nc_item cleared = NC_INIT(nc_item);
  *item = cleared;
}

/** Answer to a sync: the state of the machine at the moment when everything before the sync had been executed. */
typedef struct nc_world {
  NC_STRUCT_SIZE(nc_world); /**< see NC_STRUCT_SIZE */
  nc_axes machine;          /**< machine position of the axes */
  nc_axes skip_machine;     /**< machine position at which the skip signal came; counts only while `skipped` is true */
  uint32_t input[NC_WORDS]; /**< macro interface inputs, words of #1032..#1035 */
  bool skipped;             /**< a skip signal has ended the last G31 move */
  int64_t clock_ms;         /**< wall clock, ms since 1970-01-01 local time (#3011, #3012) */
  double power_on_ms;       /**< integrated time of power on, ms (#3001) */
  double run_ms;            /**< integrated time of automatic operation, ms (#3002) */
  double tool_angle[2];     /**< angles of the tool, deg (nc_inputs::tool_angle) */
} nc_world;
/**
 * Clear it and set its size. Any thread.
 * @param world what is to be cleared; not NULL
 */
static inline void nc_world_init(nc_world* world) {
  const nc_world cleared = NC_INIT(nc_world);
  *world = cleared;
}

#ifdef __cplusplus
}
#endif
#endif
