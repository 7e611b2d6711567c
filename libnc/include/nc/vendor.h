/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file vendor.h
 * What a maker of machines adds to a control without changing the library: codes of his own, alarm texts in the language of his
 * operators, joints behind the axes. All of it is said in nc_config; docs/embedding.md, "A vendor's own", walks through it.
 */
#ifndef NC_VENDOR_H
#define NC_VENDOR_H

#include "nc/item.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- G and M codes ----------------------------------------------------------------------------------------------- */

#define NC_MAX_VENDOR_CODES 64 /**< rows of nc_config::vendor_codes */

/** How a code calls a program (M700 13.5.2: the types that parameters register). */
typedef enum nc_call_type {
  NC_CALL_SUB = 0,        /**< as M98: the rest of the block is executed, then the program runs */
  NC_CALL_MACRO = 1,      /**< as G65: the other words of the block are arguments */
  NC_CALL_MODAL = 2,      /**< as G66: the program runs behind every move from here on, until the code that ends modal calls */
  NC_CALL_EVERY_BLOCK = 3 /**< as G66.1: every block from here on is arguments of a call */
} nc_call_type;

/** One word of a block. */
typedef struct nc_word {
  char address; /**< 'X' */
  double value; /**< as programmed; of an expression its value */
} nc_word;

/** The block in which a code of the vendor's stands, when everything before it has been executed. */
typedef struct nc_vendor_block {
  NC_STRUCT_SIZE(nc_vendor_block); /**< see NC_STRUCT_SIZE */
  char letter;           /**< of the code, 'G' or 'M' */
  uint32_t number;       /**< of the code, as nc_vendor_code::number */
  nc_source source;      /**< where the block stands; its `system` is the part system, from 0 */
  bool online;           /**< the machine runs the program; false: it is only looked at with nc_pull() */
  nc_axes machine;       /**< where the machine stands, mm or deg */
  uint32_t word_count;   /**< of `words` */
  const nc_word* words;  /**< the other words as they are written, without N and O at the head, G codes before the code (they act), and words
                              whose variable is vacant. Until the function returns. */
} nc_vendor_block;

/**
 * What a code of the vendor's does. Called while nc_feed() or nc_pull() reads the block, when everything before it has been executed: the
 * program stands until it returns, and goes on in the next block then. Feeder thread.
 *
 * It may read and write variables, offsets and parameters of `control`. What drives the part system (nc_feed(), nc_pull(), nc_answer(),
 * nc_rewind(), nc_recalculate(), nc_reset(), nc_program_select(), nc_mdi_load(), nc_position_set()) is NC_E_STATE from in here.
 * @param user nc_vendor_code::user
 * @param control the control
 * @param block the code and the other words of its block
 * @param alarm what the program stops with when the function does not answer NC_OK: `code`, `message` and `detail` may be set, and hold what the
 *              dialect says otherwise. Texts end at the end of their room at the latest.
 * @return NC_OK: done; anything else: the program stops with `alarm`, and the block has changed nothing but what the function itself has
 */
typedef nc_status (*nc_vendor_function)(void* user, nc_control* control, const nc_vendor_block* block, nc_alarm* alarm);

/** A code of the vendor's. It either calls a program or a function of the host. */
typedef struct nc_vendor_code {
  NC_STRUCT_SIZE(nc_vendor_code); /**< see NC_STRUCT_SIZE; the same in all rows of a table */
  char letter;             /**< 'G' or 'M' */
  bool override_dialect;   /**< it takes the place of a code that the dialect has, which is refused otherwise. Codes that stop, end or call
                                programs, macro calls and data input cannot be replaced. */
  uint8_t call;            /**< nc_call_type of `program` */
  uint32_t number;         /**< M: the code, 0 to 99999999; G: times 10, 0 to 9999 (G200.1 = 2001), as in nc_modal::code */
  uint32_t program;        /**< O number of the program that it calls, 1 to 99999999; 0 = `function` */
  nc_vendor_function function; /**< NULL = `program` */
  void* user;              /**< handed to `function` */
} nc_vendor_code;
/**
 * Clear it and set its size. Any thread.
 * @param code what is to be cleared; not NULL
 */
static inline void nc_vendor_code_init(nc_vendor_code* code) {
  const nc_vendor_code cleared = NC_INIT(nc_vendor_code);
  *code = cleared;
}

/* ---- alarm texts ------------------------------------------------------------------------------------------------- */

/**
 * A text of the host's in the place of one of the library's: of an alarm by its code ("P33"), of a status by its name
 * ("NC_E_STATE"). Called by nc_alarm_get(), nc_alarm_text_get() and nc_status_text_get(), so the language may change at any time.
 * Feeder thread.
 * @param user nc_config::alarm_text_user
 * @param code what a text is wanted for
 * @param text receives it, UTF-8; cleared before, and ended by the library where it fills its room
 * @param size bytes of `text`
 * @return true: `text` holds one; false: the library's own stays
 */
typedef bool (*nc_alarm_text)(void* user, const char* code, char* text, size_t size);

/* ---- joints ------------------------------------------------------------------------------------------------------ */

/**
 * Joints of a place of the machine. Called once per cycle and part system: no allocation, no lock, no system call, bounded time, and the same
 * joints for the same place. Scan thread.
 * @param user nc_kinematics::user
 * @param machine commanded machine position, mm or deg
 * @param joint receives one value for each joint, in any unit that the drives want
 * @return false: no joints reach this place
 */
typedef bool (*nc_inverse_kinematics)(void* user, const nc_axes* machine, nc_axes* joint) NC_RT;

/**
 * Machine position of measured joints, the reverse of nc_inverse_kinematics under the same conditions. Scan thread.
 * @param user nc_kinematics::user
 * @param joint measured joints
 * @param machine receives the place, mm or deg
 * @return false: it cannot be said; the place counts as not measured in this cycle
 */
typedef bool (*nc_forward_kinematics)(void* user, const nc_axes* joint, nc_axes* machine) NC_RT;

/** What a joint can. Each cycle is looked at; nothing is planned for it. */
typedef struct nc_joint_config {
  double min, max;         /**< places that it reaches, in its unit; both 0 = any */
  double max_velocity;     /**< unit/s; 0 = any */
  double max_acceleration; /**< unit/s^2; 0 = any */
} nc_joint_config;

/** Bits of nc_outputs::joint_faults. */
typedef enum nc_joint_fault_bits {
  NC_JOINT_UNREACHABLE = 1,  /**< no joints reach the commanded place, or one of them is no finite number: `joint` stays at the last good ones */
  NC_JOINT_RANGE = 2,        /**< a joint would leave its range: in the same way */
  NC_JOINT_VELOCITY = 4,     /**< a joint is faster than its limit; `joint` follows all the same */
  NC_JOINT_ACCELERATION = 8, /**< a joint changes its speed by more than its limit; `joint` follows all the same */
  NC_JOINT_ACTUAL = 16       /**< the forward function has no place for the measured joints */
} nc_joint_fault_bits;

/**
 * Joints behind the axes of a part system. The control plans in machine coordinates: feeds and limits are those of the axes, and a
 * joint's limits are only looked at when its value is there. NC_JOINT_UNREACHABLE and NC_JOINT_RANGE stop the part system as nc_inputs::alarm does,
 * until a reset in a place that is good; the joints themselves stop at once. NC_JOINT_VELOCITY and NC_JOINT_ACCELERATION are reported and stop
 * nothing: whoever wants to stay within them chooses limits of the axes that keep them.
 */
typedef struct nc_kinematics {
  NC_STRUCT_SIZE(nc_kinematics); /**< see NC_STRUCT_SIZE */
  uint8_t joint_count;           /**< 1 to NC_MAX_AXES */
  nc_joint_config joint[NC_MAX_AXES];
  nc_inverse_kinematics inverse;
  nc_forward_kinematics forward; /**< nc_inputs::actual holds joints; NULL = it holds machine positions */
  void* user;                    /**< handed to both */
} nc_kinematics;
/**
 * Clear it and set its size. Any thread.
 * @param kinematics what is to be cleared; not NULL
 */
static inline void nc_kinematics_init(nc_kinematics* kinematics) {
  const nc_kinematics cleared = NC_INIT(nc_kinematics);
  *kinematics = cleared;
}

#ifdef __cplusplus
}
#endif
#endif
