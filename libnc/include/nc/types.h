/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file types.h
 * Plain types shared by the whole public API of libnc.
 *
 * Units: lengths mm, angles degrees, time seconds, feeds mm/min (deg/min when only rotary axes move) as programmed,
 * velocities inside motion limits mm/s. Axis arrays always have NC_MAX_AXES entries in the order of the configuration;
 * entries behind `axis_count` are 0.
 */
#ifndef NC_TYPES_H
#define NC_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define NC_API
#else
#define NC_API __attribute__((visibility("default")))
#endif

/** Marks a function that the scan thread calls: no allocation, no lock, no system call, bounded work. */
#define NC_RT

#ifdef __cplusplus
extern "C" {
#endif

#define NC_MAX_AXES 8       /**< axes of one part system */
#define NC_MAX_SYSTEMS 4    /**< part systems of one control */
#define NC_MAX_SPINDLES 4   /**< spindles of one part system (M700 10.6) */
#define NC_GROUPS 22        /**< modal groups, numbered as in the manual (index 0 unused) */
#define NC_WORDS 4          /**< 32-bit words of the macro interface, each direction: #1032-#1035, #1132-#1135 */
#define NC_VARIABLE_RANGES 4 /**< further ranges of common variables that a machine can have */
#define NC_MAX_CALLS 16     /**< programs that can be open at once, the main program among them: entries of nc_alarm_calls_get() */
#define NC_MAX_NAME 260     /**< bytes of the name of a program in the store: of a file, the place before it ("198:"), its NUL */
#define NC_MAX_TEXT 128     /**< bytes of a text carried by an item, with its terminating NUL */

/**
 * Structs that may grow in a later version begin with their size in bytes as their user was compiled with it, so that program and library
 * may be of different versions: nc_config, nc_config_fault, nc_inputs, nc_outputs, nc_world, nc_item, nc_event, nc_alarm, nc_modal,
 * nc_program_info, nc_vendor_code, nc_vendor_block, nc_kinematics, nc_function, nc_block_text, nc_system_variable, nc_parameter, nc_parameter_note, nc_tap,
 * nc_restart_place, nc_restart_found, nc_passed. Every other struct stays as it
 * is, for as long as the SONAME of the library does.
 *
 * A struct that the program gives: members that an older program does not have count as their defaults. Bytes that a newer program has and this
 * library does not know must be 0, otherwise the call is refused with NC_E_ARGUMENT, so that no request is ignored silently. A struct that the
 * program receives: the bytes that both know are written, any further bytes stay as they were.
 *
 * In C++ the size is set by itself. In C it is set by the function nc_..._init() of the struct or by NC_INIT(); in a struct that was only
 * cleared it is 0, which stands for the struct of the first version with this SONAME.
 */
#ifdef __cplusplus
#define NC_STRUCT_SIZE(type) uint32_t struct_size = sizeof(type)
#define NC_INIT(type) {}
#else
#define NC_STRUCT_SIZE(type) uint32_t struct_size
#define NC_INIT(type) {.struct_size = sizeof(type)}
#endif

/** A control. The type is opaque; a control lies entirely in the memory that the caller gave to nc_create(). */
typedef struct nc_control nc_control;

/** Position of each axis of one part system, mm or deg. */
typedef struct nc_axes {
  double v[NC_MAX_AXES]; /**< mm or deg, in the order of the configuration */
} nc_axes;

/** Result of a call. Values below zero are errors of the caller; the call has changed nothing then. */
typedef enum nc_status {
  NC_OK = 0,
  NC_WAITING = 1,      /**< nothing can be done until the machine has moved on (a sync is open, the ring is full) */
  NC_BUDGET = 2,       /**< the budget of this call is used up; call again */
  NC_ENDED = 3,        /**< the program has ended (M02/M30) */
  NC_ALARMED = 4,      /**< the program stopped on an alarm; see nc_alarm_get() */
  NC_E_ARGUMENT = -1,  /**< an argument is out of range */
  NC_E_MEMORY = -2,    /**< the memory given is too small, or a table is full */
  NC_E_STATE = -3,     /**< not possible now (a program is running, ...) */
  NC_E_NOT_FOUND = -4, /**< no such program, parameter, axis, variable */
  NC_E_READ = -5       /**< a read-at callback failed */
} nc_status;

/**
 * One sentence, in English, that says what a status means. Any thread; needs no control.
 * @param status what a call has returned; any other number has a sentence, too
 * @return a constant text, never NULL
 */
NC_API const char* nc_status_text(nc_status status);

/** The controller family whose manual decides. */
typedef enum nc_dialect {
  NC_DIALECT_M700 = 0,    /**< Mitsubishi CNC 700 series, machining centre */
  NC_DIALECT_DGSHAPE = 1, /**< DGSHAPE NC code (JIS), modelling machines */
  NC_DIALECT_ISO = 2,     /**< ISO 6983 / RS-274 as CAM systems and LinuxCNC users write it, machining centre */
  NC_DIALECT_HX = 3,      /**< TurboTek HX, machining centre */
  NC_DIALECT_SERIES8 = 4, /**< SERIES 8, PMI, machining centre */
  NC_DIALECT_COUNT = 5
} nc_dialect;

/** Where an item comes from. */
typedef struct nc_source {
  uint32_t line;    /**< line of the file on which the block stands, from 1; 0 = no line (manual motion, start) */
  uint32_t program; /**< O number of the program in which the block stands; 0 for a main program without one */
  uint8_t system;   /**< part system, from 0; what people are shown begins at 1 */
  uint8_t depth;    /**< 0 in the main program, one more in each program that is called */
  uint16_t file;    /**< index of the text in the program store (several O numbers may stand in one text) */
} nc_source;

#ifdef __cplusplus
}
#endif
#endif
