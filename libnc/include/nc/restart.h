/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file restart.h
 * Begin a program again inside: behind a broken tool, a reset or a power cut.
 *
 * The program is read from its head without moving anything, up to the place: so the plane, the unit, the work offset, the tool length, the
 * variables and every other mode are those of the program there, whatever was read. What the machine would have got on the way (M, S, T, B and macro
 * outputs) is told to the host, which asks its operator what of it is to be given out. Then
 *
 *   nc_restart_begin()    nothing runs, the program is selected
 *   nc_restart_find()     until it is NC_OK
 *   cycle start           the program runs, and stands at the place in a block stop, with NC_CAUSE_RESTART. No axis moves
 *   MDI and motion by hand bring spindle, coolant, tool and axes there; NC_MANUAL_RETURN leads an axis to where the program goes on
 *   cycle start           goes on with the block. It is refused while an axis of nc_outputs::restart_axes is not there
 *
 * nc_program_select(), nc_mdi_load(), nc_pull(), nc_rewind() and a reset forget what was found; nc_position_set() is refused (NC_E_STATE). A cycle start while the place is
 * still looked for is an alarm, NC-RESTART.
 */
#ifndef NC_RESTART_H
#define NC_RESTART_H

#include "nc/item.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NC_RESTART_CODES 32 /**< M codes of nc_restart_found::m */

/** How a place in a program is named. */
typedef enum nc_restart_by {
  NC_RESTART_BLOCK = 0,   /**< `number` blocks are executed before it, in programs that are called, too: nc_outputs::blocks of the run that was stopped */
  NC_RESTART_SEQUENCE = 1, /**< the block of the main program, or of the text `file`, with this sequence number */
  NC_RESTART_LINE = 2     /**< the block on this line of the main program, or of the text `file` */
} nc_restart_by;

/** A place in a program. */
typedef struct nc_restart_place {
  NC_STRUCT_SIZE(nc_restart_place); /**< see NC_STRUCT_SIZE */
  uint8_t by;          /**< nc_restart_by */
  bool in_file;        /**< true: `file` counts; false: the text of the main program is meant */
  uint16_t file;       /**< index of a text in the program store, as in nc_source::file */
  uint64_t number;     /**< blocks, sequence number or line, as `by` says */
  uint32_t passing;    /**< of a sequence number or line: when the program comes there for so many times; 0 and 1 = for the first time */
  uint32_t mirror;     /**< nc_inputs::mirror of the start to come */
  bool start_given;    /**< true: the program was begun with the axes at `start`; false: at where they are now. It counts for programs that begin with increments */
  nc_axes start;       /**< machine position, mm or deg, -1e9..1e9 */
} nc_restart_place;
/**
 * Clear it and set its size: the first block of the main program. Any thread.
 * @param place what is to be cleared; not NULL
 */
static inline void nc_restart_place_init(nc_restart_place* place) {
  const nc_restart_place cleared = NC_INIT(nc_restart_place);
  *place = cleared;
}

/** What was found at the place: the state in which the program comes to it. */
typedef struct nc_restart_found {
  NC_STRUCT_SIZE(nc_restart_found); /**< see NC_STRUCT_SIZE */
  nc_source source;     /**< the block with which the program goes on */
  uint64_t blocks;      /**< number of blocks that come before it */
  nc_axes machine;      /**< where it begins: machine position, mm or deg */
  uint32_t modal;       /**< id of the modal snapshot there, see nc_modal_get(); 0 at the head of a program */
  uint32_t asked;       /**< nc_sync_what bits: what the program has asked the machine on the way. Inputs and the clock were answered by nc_restart_begin()'s
                             `world`, and of a skip move (NC_SYNC_SKIP) no signal has come: with another answer the program may come there otherwise */
  bool s_given, t_given, b_given; /**< a code of the kind has come */
  double s;             /**< the last S, as nc_action::value: r/min, in G96 m/min */
  uint32_t t, b;        /**< the last T and second auxiliary function */
  uint32_t m_count;     /**< number of M codes that have come, each counted once while it is in `m`; when there are more than NC_RESTART_CODES the oldest but for the tool change are not told */
  uint32_t m[NC_RESTART_CODES]; /**< each of them once, in the order in which they have come last: the newest is the last */
  uint32_t output[NC_WORDS], output_written[NC_WORDS]; /**< macro outputs: words of #1132 to #1135, and bit by bit whether the program has written it */
  uint64_t change_t;    /**< the last T that has come in front of the newest tool change (NC_CODE_TOOL_CHANGE), which means the tool in the spindle. Where it is the last T
                             at all, change_t_order is t_order; else `t` was called ahead, for the next change */
  bool change_t_given;  /**< there is such a T */
  uint32_t m_order[NC_RESTART_CODES], s_order, t_order, b_order, change_t_order; /**< for each code its place among all of them, from 1 on: what came later has the higher one */
} nc_restart_found;
/**
 * Clear it and set its size. Any thread.
 * @param found what is to be cleared; not NULL
 */
static inline void nc_restart_found_init(nc_restart_found* found) {
  const nc_restart_found cleared = NC_INIT(nc_restart_found);
  *found = cleared;
}

/**
 * What programs and blocks of MDI leave in force of the coordinate systems beside the tables of offsets. A program that is read from its head begins with it, and no
 * reset ends it but where the family says so. A search for a place begins with what is in force, too: where the run that was stopped has left a shift, that would count
 * twice. A host that knows what that run was begun with gives it back in front of nc_restart_begin().
 */
typedef struct nc_restart_coordinates {
  nc_axes shift;        /**< of all workpiece coordinate systems (G92), mm or deg */
  nc_axes shift_kept;   /**< that G92.2 has taken out of force, for G92.3; 0 in families that have no such codes */
  nc_axes local[6];     /**< local systems (G52) of G54 to G59 */
  bool polar;           /**< the polar coordinate command (G16), where a parameter keeps it in force over a reset */
} nc_restart_coordinates;

/**
 * Read what is in force of the coordinate systems. Feeder thread; also from nc_look_executed().
 * @param control the control
 * @param system part system, from 0
 * @param begun true: what the program that runs, or ran last, was begun with; one that was begun inside: what its search was begun with. false: what is in
 *        force after all blocks that have been read so far
 * @param coordinates receives it; not NULL
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `coordinates` is NULL
 */
NC_API nc_status nc_restart_coordinates_get(const nc_control* control, unsigned system, bool begun, nc_restart_coordinates* coordinates);

/**
 * Put into force what nc_restart_coordinates_get() has read. What is read next from the head of a program begins with it: to be called in front of nc_program_select(),
 * nc_reset() or nc_restart_begin(). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param coordinates copied; each value between -1e9 and 1e9
 * @return NC_OK; NC_E_STATE: a program runs; NC_E_ARGUMENT: no such part system, `coordinates` is NULL, or a value is out of range
 */
NC_API nc_status nc_restart_coordinates_set(nc_control* control, unsigned system, const nc_restart_coordinates* coordinates);

/**
 * Begin to look for a place in the selected program. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param place the place; copied
 * @param world what the program finds when it asks for inputs or the clock; its positions are not used. Copied. NULL: inputs that are off
 * @return NC_OK; NC_E_NOT_FOUND: no program is selected, or only blocks of MDI; NC_E_STATE: a program runs, or a vendor's function has called;
 *         NC_E_ARGUMENT: no such part system or text, `place` is NULL, its struct_size or that of `world` is not valid, or a number is out of range
 */
NC_API nc_status nc_restart_begin(nc_control* control, unsigned system, const nc_restart_place* place, const nc_world* world);

/**
 * Go on to look for the place. The program is executed up to it but for the machine: its writes of variables and offsets are done, and a host that gives the
 * place up puts them back. A place that another part system has found stays, as if this program had come to its own behind it. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param budget blocks that may be read before the call returns NC_BUDGET
 * @param found receives what was found with NC_OK
 * @return NC_OK: the place is found, and the next cycle start begins there; NC_BUDGET: call again; NC_ENDED: the program has ended before it came
 *         there; NC_ALARMED: it has stopped with an alarm, see nc_alarm_get(); NC_E_NOT_FOUND: there is no such sequence number, or the program cannot be
 *         begun at the place: the blocks before and behind it hang together, it is a call amid a contour, or a radius for constant surface speed was given
 *         (G92 R of Series 8); NC_E_STATE: nothing is looked for; NC_E_ARGUMENT: no such part
 *         system, `found` is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_restart_find(nc_control* control, unsigned system, uint32_t budget, nc_restart_found* found);

/**
 * Forget a place that was looked for or found: the next cycle start begins at the head of the program. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @return NC_OK; NC_E_STATE: a program runs; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_restart_cancel(nc_control* control, unsigned system);

#ifdef __cplusplus
}
#endif
#endif
