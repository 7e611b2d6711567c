/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file vendor.h
 * What a maker of machines can add to a control without changing the library: codes of his own, alarm texts in the language of his operators,
 * and joints that the axes are turned into. All of it is configured in nc_config; docs/embedding.md, "A vendor's own", explains it step by step.
 */
#ifndef NC_VENDOR_H
#define NC_VENDOR_H

#include "nc/item.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- G and M codes ----------------------------------------------------------------------------------------------- */

#define NC_MAX_VENDOR_CODES 64 /**< rows of nc_config::vendor_codes */

/** How a code calls a program (M700 13.5.2: the call types that parameters can give to a code). */
typedef enum nc_call_type {
  NC_CALL_SUB = 0,        /**< as M98: the rest of the block is executed, then the program runs */
  NC_CALL_MACRO = 1,      /**< as G65: the other words of the block are arguments */
  NC_CALL_MODAL = 2,      /**< as G66: from here on the program runs after every move, until the code that ends modal calls */
  NC_CALL_EVERY_BLOCK = 3 /**< as G66.1: from here on every block calls the program, and its words are the arguments */
} nc_call_type;

/** One word of a block. */
typedef struct nc_word {
  char address; /**< the letter, for example 'X' */
  double value; /**< the number as programmed, in the unit of the program; where an expression stands, its value */
} nc_word;

/** The block in which a code of the vendor stands, at a time when everything before it has been executed. */
typedef struct nc_vendor_block {
  NC_STRUCT_SIZE(nc_vendor_block); /**< see NC_STRUCT_SIZE */
  char letter;           /**< letter of the code, 'G' or 'M' */
  uint32_t number;       /**< number of the code, as in nc_vendor_code::number */
  nc_source source;      /**< where the block stands; its `system` is the part system, from 0 */
  bool online;           /**< true: the machine runs the program; false: nc_pull() reads it offline */
  nc_axes machine;       /**< machine position, mm or deg */
  uint32_t word_count;   /**< elements of `words` */
  const nc_word* words;  /**< the other words of the block, in the order in which they are written. Left out are N and O at its head, G codes that
                              stand before the vendor's code (they act as usual), and words whose variable is vacant. Valid until the function
                              returns. */
} nc_vendor_block;

/**
 * The function of a vendor's code. It is called while nc_feed() or nc_pull() reads the block, when everything before the block has been executed:
 * the program waits until the function returns, and then goes on with the next block. Feeder thread.
 *
 * The function may read and write variables, offsets and parameters of `control`. Calls that drive the part system (nc_feed(), nc_pull(),
 * nc_answer(), nc_rewind(), nc_recalculate(), nc_reset(), nc_program_select(), nc_mdi_load(), nc_position_set()) return NC_E_STATE in it.
 * @param user nc_vendor_code::user
 * @param control the control
 * @param block the code and the other words of its block
 * @param alarm the alarm with which the program stops when the function does not return NC_OK. Its `code`, `message` and `detail` may be set; they
 *              hold the dialect's texts before. A text that fills its room is ended there with a NUL.
 * @return NC_OK: done; anything else: the program stops with `alarm`, and nothing is changed but what the function itself has changed
 */
typedef nc_status (*nc_vendor_function)(void* user, nc_control* control, const nc_vendor_block* block, nc_alarm* alarm);

/** A code of the vendor. It calls either a program or a function of the host. */
typedef struct nc_vendor_code {
  NC_STRUCT_SIZE(nc_vendor_code); /**< see NC_STRUCT_SIZE; the same in all rows of a table */
  char letter;             /**< 'G' or 'M' */
  bool override_dialect;   /**< true: the row may replace a code that the dialect has; false: such a row is refused. Codes that stop, end or call
                                programs, macro calls and data input can never be replaced. */
  uint8_t call;            /**< nc_call_type: how `program` is called */
  uint32_t number;         /**< M: the code, 0 to 99999999; G: ten times the code, 0 to 9999 (G200.1 = 2001), as in nc_modal::code */
  uint32_t program;        /**< O number of the program that the code calls, 1 to 99999999; 0 = it calls `function` */
  nc_vendor_function function; /**< function that the code calls; NULL = it calls `program` */
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
 * Gives a text of the host that replaces one of the library: the text of an alarm, asked by its code ("P33"), or of a status, asked by its name
 * ("NC_E_STATE"). Called by nc_alarm_get(), nc_alarm_text_get() and nc_status_text_get() each time, so the language may change at any time.
 * Feeder thread.
 * @param user nc_config::alarm_text_user
 * @param code the alarm or status whose text is wanted
 * @param text receives the text, UTF-8; it is cleared before, and the library puts a NUL at its end where the text fills it
 * @param size bytes of `text`
 * @return true: `text` holds the text; false: the host has none, and the library's own text is used
 */
typedef bool (*nc_alarm_text)(void* user, const char* code, char* text, size_t size);

/* ---- joints ------------------------------------------------------------------------------------------------------ */

/**
 * Calculates the joints for a position of the machine. Called once per cycle and part system. It must not allocate, lock or call the system, must
 * take bounded time, and must give the same joints for the same position. Scan thread.
 * @param user nc_kinematics::user
 * @param machine commanded machine position, mm or deg
 * @param joint receives one value for each joint, in the unit that the drives want
 * @return false: no joint values reach this position
 */
typedef bool (*nc_inverse_kinematics)(void* user, const nc_axes* machine, nc_axes* joint) NC_RT;

/**
 * Calculates the machine position for measured joints, the reverse of nc_inverse_kinematics. The same conditions hold for it. Scan thread.
 * @param user nc_kinematics::user
 * @param joint measured joints
 * @param machine receives the position, mm or deg
 * @return false: the position cannot be calculated; it counts as not measured in this cycle
 */
typedef bool (*nc_forward_kinematics)(void* user, const nc_axes* joint, nc_axes* machine) NC_RT;

/** Limits of a joint. They are checked in each cycle; motion is not planned by them. */
typedef struct nc_joint_config {
  double min, max;         /**< smallest and largest value of the joint, in its unit; both 0 = no limit */
  double max_velocity;     /**< unit/s; 0 = no limit */
  double max_acceleration; /**< unit/s^2; 0 = no limit */
} nc_joint_config;

/** Bits of nc_outputs::joint_faults. */
typedef enum nc_joint_fault_bits {
  NC_JOINT_UNREACHABLE = 1,  /**< no joint values reach the commanded position, or one is not a finite number: nc_outputs::joint keeps the last good
                                  values */
  NC_JOINT_RANGE = 2,        /**< a joint would leave its range: nc_outputs::joint keeps the last good values */
  NC_JOINT_VELOCITY = 4,     /**< a joint is faster than its limit; nc_outputs::joint follows the command all the same */
  NC_JOINT_ACCELERATION = 8, /**< a joint exceeds its limit of acceleration; nc_outputs::joint follows the command all the same */
  NC_JOINT_ACTUAL = 16       /**< the forward function has no position for the measured joints */
} nc_joint_fault_bits;

/**
 * Joints that the axes of a part system are turned into. The control plans in machine coordinates: feeds and limits are those of the axes, and the
 * limits of a joint are checked only in the cycle that commands it. NC_JOINT_UNREACHABLE and NC_JOINT_RANGE stop the part system as
 * nc_inputs::alarm does, until a reset at a position that the joints reach; the joints themselves stop at once. NC_JOINT_VELOCITY and
 * NC_JOINT_ACCELERATION are only reported and stop nothing: to keep to them, choose limits of the axes that keep the joints within theirs.
 */
typedef struct nc_kinematics {
  NC_STRUCT_SIZE(nc_kinematics); /**< see NC_STRUCT_SIZE */
  uint8_t joint_count;           /**< 1 to NC_MAX_AXES */
  nc_joint_config joint[NC_MAX_AXES]; /**< limits of the first `joint_count` joints */
  nc_inverse_kinematics inverse; /**< not NULL */
  nc_forward_kinematics forward; /**< not NULL: nc_inputs::actual holds measured joints; NULL: it holds machine positions */
  void* user;                    /**< handed to both functions */
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
