/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file control.h
 * Create and configure a control, give it programs, set its tables.
 *
 * Threads: unless a function says otherwise it belongs to the *feeder* thread (one thread, the one that calls nc_feed() or
 * nc_pull()). Only functions marked NC_RT belong to the scan thread. Two different controls never share anything.
 * Errors: a control that is NULL is NC_E_ARGUMENT, as is NULL for a pointer that a function needs. Functions without a status do nothing then, nor for a
 * part system that does not exist.
 * Ownership: everything lives in the memory given to nc_create(); pointers returned are valid as long as the control.
 */
#ifndef NC_CONTROL_H
#define NC_CONTROL_H

#include "nc/item.h"
#include "nc/vendor.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One axis. A limit of 0 means "no limit", so a control that only traces programs needs the name alone. Limits may be at most 1e12, positions must
 *  lie between -1e9 and 1e9. */
typedef struct nc_axis_config {
  char name;               /**< address letter, A B C U V W X Y Z */
  bool rotary;             /**< true: a rotary axis, in degrees; false: a linear axis, in mm */
  double rapid;            /**< rapid traverse rate, mm/s or deg/s; 0 = max_velocity */
  double max_velocity;     /**< mm/s or deg/s; it also clamps the cutting feed of the axis */
  double max_acceleration; /**< mm/s^2 or deg/s^2 */
  double max_jerk;         /**< mm/s^3 or deg/s^3 */
  double in_position;      /**< in-position width, mm or deg */
  bool soft_limited;       /**< true: soft_min and soft_max limit the axis; false: they mean nothing */
  double soft_min, soft_max; /**< stored stroke limits, machine coordinates */
  double reference[4];     /**< 1st to 4th reference position, machine coordinates */
  uint8_t spindle;         /**< a C axis: number (from 1) of the spindle that becomes this rotary axis while its servo is on (M700 10.5); 0 = no spindle */
  double reserved[8];      /**< for members of later versions, must be 0 */
} nc_axis_config;

/** One part system. */
typedef struct nc_system_config {
  uint8_t axis_count;      /**< 1..NC_MAX_AXES */
  nc_axis_config axis[NC_MAX_AXES]; /**< nothing of those behind axis_count is looked at */
  uint8_t spindle_count;   /**< 1..NC_MAX_SPINDLES; 0 = one */
  uint64_t spindle_unsigned; /**< bit n: the speed in nc_inputs::spindle[n] is measured without a sign, so a thread does not check in which
                                  direction this spindle turns */
  double reserved[7];      /**< for members of later versions, must be 0 */
} nc_system_config;

/** How the machine moves along the path. */
typedef enum nc_motion_mode {
  NC_MOTION_TRAPEZOID = 0, /**< limits the velocity and the acceleration of each axis, but not its jerk. It is the value 0, which a cleared config has, because it
                                needs the fewest limits and the least memory */
  NC_MOTION_OPTIMAL = 1    /**< the shortest time within the limits of velocity, acceleration and jerk of every axis; all three must be set for each axis */
} nc_motion_mode;

/** A range of common variables that a machine has in addition to those of nc_config::variable_sets, for example #400 to #499. */
typedef struct nc_variable_range {
  uint32_t first, last;    /**< first and last variable number, 34 to 999999, at most 10000 variables; both 0 = the range is not used */
} nc_variable_range;

/** What a control is. Fill with nc_config_init(), then change what differs. */
typedef struct nc_config {
  NC_STRUCT_SIZE(nc_config); /**< see NC_STRUCT_SIZE; set by nc_config_init() */
  uint8_t dialect;         /**< nc_dialect */
  uint8_t system_count;    /**< 1..NC_MAX_SYSTEMS */
  nc_system_config system[NC_MAX_SYSTEMS]; /**< nothing of those behind system_count is looked at */
  double cycle_s;          /**< servo cycle, s, 1e-6..0.1; default 0.001 */
  uint32_t look_ahead;     /**< records in the ring between feeder and scan, power of two 64..65536; default 1024 (15 MB).
                                In the time-optimal mode a row of short lines runs at full speed only if the lines in the ring, each of which takes
                                two records, are together longer than the braking distance of the machine: lines of 1 um need 16384 records (89 MB) */
  uint32_t programs;       /**< entries of the program store, 1..65535; default 256 */
  uint32_t tool_offsets;   /**< number of tool offset sets, 1..999; default 200 */
  uint32_t work_offsets;   /**< number of extended work offsets: n of G54.1 P1..Pn, 0..300; default 96 */
  uint32_t variable_sets;  /**< number of common variables, as the option of the manual: 100, 200, 300 or 600 (M700 13.4); default 600 */
  bool extended_variables; /**< true: the common variables #900000 to #907399 of later models exist, too; default false */
  uint32_t window_bytes;   /**< bytes of program text that each part system holds in memory at once, 512..16777216; default 65536 */
  double max_feed_override; /**< largest value of nc_inputs::feed_override, 1..10; default 2.0 */
  uint8_t motion_mode;     /**< nc_motion_mode; default NC_MOTION_TRAPEZOID (ncrtd and ncsim choose NC_MOTION_OPTIMAL where every axis has all limits) */
  double path_tolerance;   /**< mm, 0 or 1e-5..10; default 0.01. NC_MOTION_OPTIMAL: the largest distance by which corners between lines may leave the
                                programmed path; 0: the path is kept exactly, with a rest at each corner. NC_MOTION_TRAPEZOID: the largest distance by
                                which high-accuracy control rounds corners; 0: it rounds none */
  nc_variable_range variable_ranges[NC_VARIABLE_RANGES]; /**< further common variables, shared by all part systems. The ranges must not overlap one
                                another, the variables of the two options above, local variables or system variables */
  const nc_vendor_code* vendor_codes; /**< the vendor's own codes, `vendor_code_count` rows; copied by nc_create(). NULL = none */
  uint32_t vendor_code_count;         /**< rows of `vendor_codes`, 0 to NC_MAX_VENDOR_CODES */
  nc_alarm_text alarm_text;           /**< the host's function that replaces texts of the library; NULL = the library's texts are used */
  void* alarm_text_user;              /**< handed to `alarm_text` */
  const nc_kinematics* kinematics[NC_MAX_SYSTEMS]; /**< for each part system the joints that its axes are turned into; copied by nc_create().
                                NULL = the part system has no joints, its axes themselves are driven */
  uint32_t contour_blocks;            /**< blocks of the longest contour that the check of its walls takes (the parameter CONTOUR_CHECK of m700), 16 to 1000000;
                                default 3800 (1.5 MB for each part system; memory that no contour has needed is never written). A longer contour is an
                                alarm where the check is on */
  double retract_overlap;             /**< mm, 0 to 100; default 0. NC_MOTION_OPTIMAL: between two holes of a fixed cycle the tool goes on by so much beyond
                                its return level (R or the initial level) and passes from the retract into the traverse, and from there down, in one
                                curve each, without a rest. Where it is below that level the axes of the plane stand. 0: it stops at the level */
  double tap_most_apart;              /**< revolutions, 0.05 to 100; default 2. A spindle that is farther from what a synchronous tap commands does not
                                follow it: an alarm */
} nc_config;

/**
 * Set every member to its default: M700, one part system with X Y Z without limits. Any thread. It is for languages that cannot use the
 * inline function nc_config_init().
 * @param config receives the defaults; NULL does nothing
 * @param struct_size bytes of `config`, sizeof(nc_config); a number below 4 or above 65536 does nothing
 */
NC_API void nc_config_init_sized(nc_config* config, size_t struct_size);

/**
 * Set every member to its default, as nc_config_init_sized() does. Any thread.
 * @param config receives the defaults; NULL does nothing
 */
static inline void nc_config_init(nc_config* config) { nc_config_init_sized(config, sizeof(nc_config)); }

/** Which member of a configuration is refused, and why. */
typedef struct nc_config_fault {
  NC_STRUCT_SIZE(nc_config_fault); /**< see NC_STRUCT_SIZE */
  char field[64];          /**< the member, written as in C: "system[0].axis[2].max_velocity" */
  char reason[160];        /**< what the member has to be: "must be 0 to 1e12 mm/s or deg/s; 0 = no limit" */
} nc_config_fault;

/**
 * Check whether nc_create() accepts a configuration. Any thread; needs no control.
 * @param config the configuration
 * @param fault receives the first member that is refused; untouched when there is none. May be NULL.
 * @return NC_OK; NC_E_ARGUMENT when a member is refused, or `config` is NULL (then *fault is untouched)
 */
NC_API nc_status nc_config_check(const nc_config* config, nc_config_fault* fault);

/**
 * Check whether nc_create() accepts nc_config::variable_ranges[index]. Any thread; needs no control.
 * @param config the configuration with its options and other ranges
 * @param index of the range, 0 to NC_VARIABLE_RANGES - 1
 * @param taken receives the first number of the range that another variable has already; 0 when there is none, or the range itself is not valid.
 *              May be NULL.
 * @return NC_OK, also for a range that is not used; NC_E_ARGUMENT: the range is refused, `config` is NULL, or `index` is out of range
 */
NC_API nc_status nc_variable_range_check(const nc_config* config, unsigned index, uint32_t* taken);

/**
 * Bytes that nc_create() needs for a configuration. Any thread.
 * @param config the configuration
 * @return bytes; 0 when the configuration is refused: nc_config_check() says why
 */
NC_API size_t nc_memory_required(const nc_config* config);

/**
 * Build a control in memory of the caller; nothing else is ever allocated. Any thread.
 * @param config the configuration; copied
 * @param memory aligned to 64 bytes, kept by the caller for as long as the control is used; its contents do not matter
 * @param size bytes of `memory`, at least nc_memory_required()
 * @param status receives NC_OK; NC_E_ARGUMENT: the configuration is refused (nc_config_check() says why), or `memory` is NULL or not
 *               aligned; NC_E_MEMORY: `size` is too small. May be NULL.
 * @return the control, or NULL. There is nothing to destroy: when it is no longer used, reuse the memory.
 */
NC_API nc_control* nc_create(const nc_config* config, void* memory, size_t size, nc_status* status);

/* ---- parameters, tables, variables ------------------------------------------------------------------------------ */

/**
 * Set a control parameter by the manual's number or name. Feeder thread.
 * @param control the control
 * @param system part system, from 0; a parameter that all part systems share (M700 #1121, #1129, #1303, #1304, #8105) is set for all of them,
 *             whichever one is given
 * @param key  "1078", "1267/bit0", "UNIT*10", DGSHAPE "interpretation", ...; a parameter of the dialect that has no effect in this control
 *             is accepted and kept
 * @param axis name of the axis for a parameter that each axis has for itself, 0 = all axes
 * @param text value as text, in the manual's units: a number, or a word of the manual ("B" for #1003)
 * @return NC_OK; NC_E_NOT_FOUND: no such key; NC_E_ARGUMENT: no such part system or axis, a pointer is NULL, or the value is out of the parameter's range;
 *         NC_E_MEMORY: too many parameters are set
 */
NC_API nc_status nc_parameter_set(nc_control* control, unsigned system, const char* key, char axis, const char* text);

/**
 * Value of a parameter that is a number. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param key  as for nc_parameter_set()
 * @param axis name of the axis, 0 = the value for all axes
 * @param value receives the value, in the manual's units; 0 when it was never set
 * @return NC_OK; NC_E_NOT_FOUND: no such key; NC_E_ARGUMENT: no such part system or axis, or a pointer is NULL
 */
NC_API nc_status nc_parameter_get(const nc_control* control, unsigned system, const char* key, char axis, double* value);

/** Parameters that a host can ask for by what they do, whatever the dialect calls them. */
typedef enum nc_parameter_role {
  NC_PARAMETER_DECIMAL_TYPE_2 = 0,   /**< a number without a decimal point is in mm (M700 5.3) */
  NC_PARAMETER_DWELL_POINT = 1,      /**< the decimal point of P in a dwell is not ignored (M700 8.1) */
  NC_PARAMETER_TOOL_MEMORY = 2,      /**< memory type of tool offsets, 1 or 2 (M700 12.1) */
  NC_PARAMETER_POWER_OFF_CLEARS = 3, /**< power off clears the common variables of NC_VARIABLES_CLEARED (M700 13.4) */
  NC_PARAMETER_DIGIT_FEED = 4        /**< speed of the one-digit feed F1; the parameters of F2 to F5 have the keys that follow (M700 7.3) */
} nc_parameter_role;

/**
 * Key of a parameter that a host asks for by what it does. Any thread.
 * @param control the control
 * @param role what the parameter does
 * @param key receives its key in the control's dialect, as nc_parameter_set() takes it
 * @return NC_OK; NC_E_NOT_FOUND: the dialect has no such parameter; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_parameter_key_get(const nc_control* control, nc_parameter_role role, char key[24]);

/**
 * How lengths and positions without a decimal point are read, with the parameters that are set. Feeder thread.
 * @param control the control
 * @param system index of the part system
 * @param whole receives true: in whole mm, inch or deg (X10 is 10 mm); false: in the least unit of the dialect (X10 is 0.010 mm)
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_undotted_get(const nc_control* control, unsigned system, bool* whole);

/**
 * Set one entry of the work offset tables. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param index 0 = external, 1..6 = G54..G59, 100+n = G54.1 Pn
 * @param axis of the configuration, from 0
 * @param value mm or deg, between -1e9 and 1e9
 * @return NC_OK; NC_E_ARGUMENT: no such part system, index or axis, or the value is out of range
 */
NC_API nc_status nc_work_offset_set(nc_control* control, unsigned system, unsigned index, unsigned axis, double value);

/**
 * Read one entry of the work offset tables. It is the value after all blocks that have been read so far, executed or not. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param index as for nc_work_offset_set()
 * @param axis of the configuration, from 0
 * @param value receives it, mm or deg
 * @return NC_OK; NC_E_ARGUMENT: no such part system, index or axis, or `value` is NULL
 */
NC_API nc_status nc_work_offset_get(const nc_control* control, unsigned system, unsigned index, unsigned axis, double* value);

/** Tool offset columns (M700 12.1). In memory type I all columns but NC_TOOL_LENGTH are unused. */
typedef enum nc_tool_column { NC_TOOL_LENGTH = 0, NC_TOOL_LENGTH_WEAR = 1, NC_TOOL_RADIUS = 2, NC_TOOL_RADIUS_WEAR = 3 } nc_tool_column;

/**
 * Set one entry of the tool offset table, which all part systems share. Feeder thread.
 * @param control the control
 * @param number of the set, 1 to nc_config::tool_offsets
 * @param column nc_tool_column
 * @param value mm, between -1e9 and 1e9
 * @return NC_OK; NC_E_ARGUMENT: no such set or column, or the value is out of range
 */
NC_API nc_status nc_tool_offset_set(nc_control* control, unsigned number, nc_tool_column column, double value);

/**
 * Read one entry of the tool offset table. It is the value after the blocks that part system 0 has read and the others have executed. Feeder
 * thread.
 * @param control the control
 * @param number of the set, 1 to nc_config::tool_offsets
 * @param column nc_tool_column
 * @param value receives it, mm
 * @return NC_OK; NC_E_ARGUMENT: no such set or column, or `value` is NULL
 */
NC_API nc_status nc_tool_offset_get(const nc_control* control, unsigned number, nc_tool_column column, double* value);

/** Number of tools whose life can be managed. */
#define NC_TOOL_LIVES 200

/** Columns of the table of tool life (M700 13.5.5, #60501 to #64700). */
typedef enum nc_life_column {
  NC_LIFE_GROUP = 0,     /**< number of its group, 1 to 99999999; 0 = no tool is registered here */
  NC_LIFE_TOOL = 1,      /**< number of the tool, 0 to 99999999 */
  NC_LIFE_FLAGS = 2,     /**< bits 4, 5: what is counted: 0 minutes of cutting, 1 mounts, 2 uses; the others are given back as they are; 0 to 255 */
  NC_LIFE_STATUS = 3,    /**< 0 not used, 1 in use, 2 its life has ended, 3 and 4 not to be used */
  NC_LIFE_LIFE = 4,      /**< its life in minutes (0 to 4000) or times (0 to 9999); 0 = without end */
  NC_LIFE_USED = 5,      /**< what of it has been used */
  NC_LIFE_LENGTH = 6,    /**< number of its offset for the length */
  NC_LIFE_RADIUS = 7,    /**< number of its offset for the radius */
  NC_LIFE_AUXILIARY = 8  /**< for the machine's own use */
} nc_life_column;

/**
 * Set one entry of the table of tool life, which all part systems share. Feeder thread.
 * @param control the control
 * @param number of the tool in the table, 1 to NC_TOOL_LIVES: the tools of a group are used in this order
 * @param column nc_life_column
 * @param value in the range of its column; whole numbers but for minutes and NC_LIFE_AUXILIARY
 * @return NC_OK; NC_E_ARGUMENT: no such number or column, or the value is out of range
 */
NC_API nc_status nc_tool_life_set(nc_control* control, unsigned number, nc_life_column column, double value);

/**
 * Read one entry of the table of tool life, as nc_tool_offset_get() does. Feeder thread.
 * @param control the control
 * @param number of the tool in the table, 1 to NC_TOOL_LIVES
 * @param column nc_life_column
 * @param value receives it
 * @return NC_OK; NC_E_ARGUMENT: no such number or column, or `value` is NULL
 */
NC_API nc_status nc_tool_life_get(const nc_control* control, unsigned number, nc_life_column column, double* value);

/**
 * Set a local or common variable. Feeder thread.
 * @param control the control
 * @param system part system, from 0; a variable that all part systems share is set for all of them, whichever one is given
 * @param number of the variable; local ones are those of the program that is being read
 * @param value its value, finite
 * @param vacant true: it becomes vacant (#0), and `value` does not count
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `value` is no finite number; NC_E_NOT_FOUND: no such variable, or a system variable
 */
NC_API nc_status nc_variable_set(nc_control* control, unsigned system, uint32_t number, double value, bool vacant);

/**
 * Read a local or common variable. It is the value after the blocks that this part system has read so far, executed or not; for a shared variable
 * the blocks that the other part systems have executed count, too. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param number of the variable; local ones are those of the program that is being read
 * @param value receives its value
 * @param vacant receives whether it is vacant (#0)
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or a pointer is NULL; NC_E_NOT_FOUND: no such variable, or a system variable
 */
NC_API nc_status nc_variable_get(const nc_control* control, unsigned system, uint32_t number, double* value, bool* vacant);

/**
 * Give the next parameter that is set. Parameters have places, numbered in the order in which they were first set; the search begins at place
 * `from`. A parameter of which only one bit was set ("1267/bit0") is given as a whole; one whose setting has been taken back is left out. Feeder
 * thread.
 * @param control the control
 * @param system part system, from 0
 * @param from place at which the search begins, from 0
 * @param place receives the place of the parameter: the next search begins at place + 1
 * @param key receives its key
 * @param axis receives the name of its axis, 0 = all axes
 * @param value receives its value in the manual's units, when the value is a number or one character
 * @param text receives a value of two or more characters, at most 63; else ""
 * @return NC_OK; NC_E_NOT_FOUND: there is none; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_parameter_next(const nc_control* control, unsigned system, unsigned from, unsigned* place, char key[24], char* axis,
                                   double* value, char text[64]);

/**
 * Notes about the parameters that are set, one sentence each: which of them have no effect on this machine, and where a time constant and not
 * the feed limits the speed (docs/motion.md, "Behind interpolation"). They come in the order of the parameter numbers, then of the axes. Feeder
 * thread.
 * @param control the control
 * @param system part system, from 0
 * @param index of the sentence, from 0
 * @param text receives the sentence, cut to `size` bytes with its NUL; 200 bytes are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_NOT_FOUND: there is no such sentence, `index` is behind the last one; NC_E_ARGUMENT: no such part system, `text` is NULL, or
 *         `size` is 0
 */
NC_API nc_status nc_parameter_note_row(const nc_control* control, unsigned system, unsigned index, char* text, size_t size);

/**
 * Called by nc_look_executed(). During the call variables, their names, offsets and parameters have the values that they have after the blocks
 * which the machine has executed: these are the values to keep while the power is off. After the call they have again the values after the
 * blocks that were read ahead. The function must only read. Feeder thread.
 * @param user what nc_look_executed() was given
 * @param control the control
 */
typedef void (*nc_look)(void* user, const nc_control* control);

/**
 * Call `look` while the tables have the values after the executed blocks (see nc_look). Feeder thread.
 * @param control the control
 * @param look called once, before this function returns
 * @param user handed to it
 */
NC_API void nc_look_executed(nc_control* control, nc_look look, void* user);

/**
 * Give the first common variable, with a number of `from` or above, that is not vacant. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param from number at which the search begins
 * @param number receives its number: the next search begins at number + 1
 * @param value receives its value
 * @return NC_OK; NC_E_NOT_FOUND: there is none; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_variable_next(const nc_control* control, unsigned system, uint32_t from, uint32_t* number, double* value);

/**
 * A hash over everything that decides how a program goes on after the blocks that were read so far: modes and words in force, the place in the
 * program and in those that have called it, position, variables, offsets, parameters, outputs. A program that comes to the same place twice with
 * the same hash, and gets nothing from outside in between (clock, inputs, a write by the host), never ends. The function reads every table, so
 * call it now and then, not for every block. Hashes of different versions of the library cannot be compared. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param hash receives it
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `hash` is NULL
 */
NC_API nc_status nc_program_state_hash(const nc_control* control, unsigned system, uint64_t* hash);

/* ---- programs --------------------------------------------------------------------------------------------------- */

/**
 * Reads a piece of a text. Feeder thread.
 * @param user what nc_program_add() was given
 * @param offset of the first byte that is wanted, from 0
 * @param buffer receives the bytes
 * @param size how many are wanted
 * @return bytes read; 0 at the end; negative on failure: NC_READ_FAILED, or NC_READ_CHANGED. Either becomes an alarm on the block that needed the
 *         text; what is in `buffer` then is not used.
 */
typedef long (*nc_read_at)(void* user, uint64_t offset, char* buffer, size_t size);

/** The text cannot be read. Any other negative number except NC_READ_CHANGED means the same. */
#define NC_READ_FAILED (-1L)
/** The text is no longer the one that was entered: somebody has written to its file. */
#define NC_READ_CHANGED (-2L)

/**
 * Enter a text into the program store. It is read piece by piece, never as a whole, and read again wherever a program jumps: the text that `read`
 * gives must stay unchanged until its entry is replaced or removed. Anybody may overwrite a file meanwhile, so a host copies the text of a file
 * or watches the file: this library's own hosts (ncrtd, ncsim) keep a copy of a file of up to 16 MiB, and for a larger one compare size, time,
 * place and a hash of each part with what they were; their `read` gives NC_READ_CHANGED when one of them differs. Feeder thread.
 * @param control the control
 * @param name file name without folder, at most NC_MAX_NAME - 1 bytes; "O1000", "1000", "1000.nc" make it program 1000 even when the text has no O
 *             line. In a family whose program numbers have another letter it is that letter. Copied. An entry of the same name is replaced.
 * @param read gives pieces of the text, in the feeder thread
 * @param user handed to `read`
 * @param size bytes of the text
 * @param file receives the index of the entry (nc_source::file), from 0. May be NULL.
 * @return NC_OK; NC_E_ARGUMENT: `control` or `read` is NULL, there is no name, or it is too long; NC_E_STATE: the entry of this name runs (online)
 *         or is protected (M700 #8105: O8000 to O9999, #1121: O9000 to O9999); NC_E_MEMORY: all places (nc_config::programs) are taken,
 *         nc_program_remove() frees one. MDI programs take none of these places.
 */
NC_API nc_status nc_program_add(nc_control* control, const char* name, nc_read_at read, void* user, uint64_t size, unsigned* file);

/**
 * Enter a text that lies in memory into the program store. Feeder thread.
 * @param control the control
 * @param name as for nc_program_add()
 * @param text the text; not copied: the caller keeps it unchanged until its entry is replaced or removed
 * @param length bytes of `text`
 * @param file receives the index of the entry, from 0. May be NULL.
 * @return as nc_program_add()
 */
NC_API nc_status nc_program_add_text(nc_control* control, const char* name, const char* text, size_t length, unsigned* file);

/** What a place of the program store holds. */
typedef struct nc_program_info {
  NC_STRUCT_SIZE(nc_program_info); /**< see NC_STRUCT_SIZE */
  char name[NC_MAX_NAME]; /**< as it was given to nc_program_add() or nc_program_add_text() */
  uint32_t number;      /**< O number that the name stands for, 0 = none */
  uint64_t size;        /**< bytes of the text */
  uint64_t used;        /**< value of a counter that the control advances each time a program is entered, selected or called: the place with the
                             largest number was used last */
  bool in_use;          /**< something refers to the program, so nc_program_remove() refuses it */
  bool is_protected;    /**< a parameter protects its O number (M700 #8105, #1121) */
} nc_program_info;
/**
 * Clear it and set its size. Any thread.
 * @param info what is to be cleared; not NULL
 */
static inline void nc_program_info_init(nc_program_info* info) {
  const nc_program_info cleared = NC_INIT(nc_program_info);
  *info = cleared;
}

/**
 * What a place of the program store holds. Feeder thread.
 * @param control the control
 * @param file index of the place, from 0 to nc_config::programs - 1
 * @param info receives it
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_ARGUMENT: a pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_program_get(const nc_control* control, unsigned file, nc_program_info* info);

/**
 * Take a text out of the program store. The text is not read any more, and its index may be given to another text. Feeder thread.
 * @param control the control
 * @param file its index
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_STATE: the program is protected, or something refers to it: it is selected in a part
 *         system, it is in a call stack (also in one that comes back when blocks that were read ahead are taken back), or it is the program of a
 *         modal call or of the macro interrupt; NC_E_ARGUMENT: `control` is NULL
 */
NC_API nc_status nc_program_remove(nc_control* control, unsigned file);

/**
 * Called when a sub program is not in the store: the host may add it with nc_program_add() from inside this call. Feeder thread.
 * @param user what nc_program_on_missing() was given
 * @param control the control
 * @param name "O1000" or the name between < >; for M198 with "198:" before it, for M98 ,D1 to ,D4 with "D1:" to "D4:" before it. The program has to
 *             be added under exactly this name.
 * @return true when the program has been added
 */
typedef bool (*nc_program_missing)(void* user, nc_control* control, const char* name);

/**
 * Set the function that is called for sub programs that are not in the store. Feeder thread.
 * @param control the control
 * @param callback called in the feeder thread, from inside nc_pull() or nc_feed(); NULL = no function
 * @param user handed to it
 */
NC_API void nc_program_on_missing(nc_control* control, nc_program_missing callback, void* user);

/**
 * Say that the text of a program is being edited, or no longer is. A program that begins while it is being edited, as the main program or by a call,
 * stops with an alarm (M700 P235). Feeder thread.
 * @param control the control
 * @param file its index
 * @param editing true: editing begins; false: it has ended
 * @return NC_OK; NC_E_STATE: the program runs, or is protected, and editing cannot begin; NC_E_ARGUMENT: the place is free
 */
NC_API nc_status nc_program_edit(nc_control* control, unsigned file, bool editing);

/** What the bytes of a program are. */
typedef enum nc_tape {
  NC_TAPE_NONE,  /**< text without a label: all of it is program */
  NC_TAPE_TEXT,  /**< text that begins with a label: everything up to the first end of block is skipped (M700 3.1) */
  NC_TAPE_ISO,   /**< rows of a punched tape, beginning with such a label, in ISO code R-840: each row has an even number of holes */
  NC_TAPE_EIA    /**< rows of a punched tape, beginning with such a label, in EIA code RS-244: each row has an odd number of holes */
} nc_tape;

/**
 * Say that a program is a tape. The bytes of NC_TAPE_ISO and NC_TAPE_EIA are the rows of the tape, hole 1 being the lowest bit. Every row is checked
 * as its block is read; the number of characters of a block is checked where the parity V parameter of the input device says so (M700 3.6: #9115 to
 * #9515). A program that runs from a tape cannot jump. Feeder thread.
 * @param control the control
 * @param file index of the program
 * @param tape nc_tape
 * @param unit input device that has read it, 1 to 5
 * @return NC_OK; NC_E_STATE: the program runs, or is protected; NC_E_READ: its text cannot be read; NC_E_ARGUMENT: the place is free, or a
 *         number is out of range
 */
NC_API nc_status nc_program_tape(nc_control* control, unsigned file, uint8_t tape, unsigned unit);

/**
 * Select the main program of a part system and go to its first block. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param file index of the program
 * @return NC_OK; NC_E_NOT_FOUND: there is no program with this index; NC_E_STATE: a program runs in this part system; NC_E_ARGUMENT: no such part
 *         system
 */
NC_API nc_status nc_program_select(nc_control* control, unsigned system, unsigned file);

/**
 * Take blocks of MDI. They become the main program; in a block stop they run with the next start, before the program. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param text the blocks; copied. In a block stop blank ones take back what waits, and the machine stops behind the blocks (NC_CAUSE_MDI_ENDED)
 * @param length bytes of `text`, at most 1024
 * @return NC_OK; NC_E_STATE: a program runs, or cannot be interrupted here (M700 12.4.4); NC_E_ARGUMENT: no such part system, `text` is NULL, or too long
 */
NC_API nc_status nc_mdi_load(nc_control* control, unsigned system, const char* text, size_t length);

/* ---- state ------------------------------------------------------------------------------------------------------ */

/**
 * Set the position of the machine while nothing runs; all axes count as referenced. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param machine machine coordinates, mm or deg, between -1e9 and 1e9; copied
 * @return NC_OK; NC_E_STATE: a program runs; NC_E_ARGUMENT: no such part system, `machine` is NULL, or a coordinate is out of range
 */
NC_API nc_status nc_position_set(nc_control* control, unsigned system, const nc_axes* machine);

/**
 * Convert positions to what the position counters show. The type of a rotary axis (M700 14.13: #8213) decides: with types 0, 1 and 2 its machine
 * coordinate, and with types 0 and 1 its workpiece coordinate, is shown as 0 <= angle < 360. In items, events and set-points the angle of such
 * an axis counts on over several turns. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param machine machine coordinates, mm or deg, which are replaced by what is shown. May be NULL.
 * @param work workpiece coordinates, mm or deg, which are replaced by what is shown. May be NULL.
 */
NC_API void nc_position_shown(const nc_control* control, unsigned system, nc_axes* machine, nc_axes* work);

/** Variables that a host can ask for by what holds for them, whatever their numbers are in the dialect. */
typedef enum nc_variable_kind {
  NC_VARIABLES_LOCAL = 0,  /**< those of each program and macro level (M700 13.5.5) */
  NC_VARIABLES_NAMED = 1,  /**< common variables that can have a name (M700 13.5.5) */
  NC_VARIABLES_CLEARED = 2 /**< common variables that reset and power off clear where parameters say so; see NC_PARAMETER_POWER_OFF_CLEARS (M700 13.4) */
} nc_variable_kind;

/**
 * The numbers of the variables of a kind. Not all of them need to exist: the options of nc_config say which common variables there are. Any thread;
 * needs no control.
 * @param dialect the controller family; of a control the one that nc_control_dialect() gives
 * @param kind which variables
 * @param range receives the first and the last number
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_variable_kind_get(nc_dialect dialect, nc_variable_kind kind, nc_variable_range* range);

/**
 * Name of a common variable (SETVN; M700 13.5.5). Feeder thread.
 * @param control the control
 * @param number of the variable
 * @param name receives the name with its NUL; "" = the variable has no name
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL
 */
NC_API nc_status nc_variable_name_get(const nc_control* control, uint32_t number, char name[8]);

/**
 * Give a common variable a name, for example one that was kept while the power was off. Feeder thread.
 * @param control the control
 * @param number of the variable, one of NC_VARIABLES_NAMED
 * @param name at most 7 capital letters and digits, a letter first; "" takes the name away. Copied.
 * @return NC_OK; NC_E_ARGUMENT: the variable can have no name, or the name is not a valid one
 */
NC_API nc_status nc_variable_name_set(nc_control* control, uint32_t number, const char* name);

/**
 * Reads a device of the PLC for #100110 (M700 13.5.5). Feeder thread.
 * @param user what nc_device_on_read() was given
 * @param code kind of device, by the manual's table
 * @param number of the device
 * @param value receives the state: 0 or 1 of a bit device, 16 bits of a word device
 */
typedef void (*nc_device_read)(void* user, unsigned code, uint32_t number, uint32_t* value);

/**
 * Set the function that reads devices of the PLC. Without one the devices do not exist, and reading one is an alarm (P39). Feeder thread.
 * @param control the control
 * @param callback called in the feeder thread; NULL = no function
 * @param user handed to it
 */
NC_API void nc_device_on_read(nc_control* control, nc_device_read callback, void* user);

/**
 * Tell the interpreter which macro interface outputs (#1132 to #1135) are on at the machine. A program that reads them gets these values until it
 * writes them itself; the outputs themselves are not changed. Call it before nc_program_select() or nc_mdi_load(), since blocks that were
 * already read ahead are not read again. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param word 0..3: #1132 to #1135
 * @param mask the bits that are given
 * @param bits their values; bits outside `mask` do not count
 * @return NC_OK; NC_E_ARGUMENT: no such part system or word
 */
NC_API nc_status nc_interface_output_set(nc_control* control, unsigned system, unsigned word, uint32_t mask, uint32_t bits);

/**
 * Macro interface outputs (#1132 to #1135) after the blocks that the interpreter has read so far, for sinks. What the machine gets is in
 * nc_outputs::output. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param word 0 to NC_WORDS - 1
 * @param bits receives 32 outputs, bit 0 the first
 * @return NC_OK; NC_E_ARGUMENT: no such part system or word, or `bits` is NULL
 */
NC_API nc_status nc_interface_output_get(const nc_control* control, unsigned system, unsigned word, uint32_t* bits);

/**
 * Set the switches of the operator that act when a block is read; blocks that were read already are not read again. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param optional_skip bit n = optional block skip switch n (1 to 9) is on; bit 1 is that of the plain '/'
 * @param mirror_axes bit i: the next program is mirrored from its beginning, in axis i, about the position where the axis stands at that time
 */
NC_API void nc_switches_set(nc_control* control, unsigned system, uint32_t optional_skip, uint32_t mirror_axes);

/**
 * The alarm that stopped a part system, of its program or of the control itself (NC-INTERNAL). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param alarm receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: there is no alarm (a stop by nc_inputs::alarm is none of the control); NC_E_ARGUMENT: no such part system, a
 *         pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_alarm_get(const nc_control* control, unsigned system, nc_alarm* alarm);

/**
 * Short text of an alarm: the text that the host gives (nc_config::alarm_text), else the one of the dialect's manual. Feeder thread.
 * @param control the control
 * @param code code of the alarm, as in nc_alarm::code
 * @param text receives the text, cut to `size` bytes with its NUL; NC_MAX_TEXT bytes are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_NOT_FOUND: neither the host nor the dialect has a text for this code; NC_E_ARGUMENT: a pointer is NULL, or `size` is 0
 */
NC_API nc_status nc_alarm_text_get(const nc_control* control, const char* code, char* text, size_t size);

/**
 * What a status means: the text that the host gives (nc_config::alarm_text, asked by the name of the status, "NC_E_STATE"), else nc_status_text().
 * Feeder thread.
 * @param control the control
 * @param status what a call has returned; any other number has a sentence, too
 * @param text receives the text, cut to `size` bytes with its NUL; NC_MAX_TEXT bytes are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL, or `size` is 0
 */
NC_API nc_status nc_status_text_get(const nc_control* control, nc_status status, char* text, size_t size);

/**
 * The blocks that led to the alarm of nc_alarm_get(), outermost first: each of them called the program of the next one, the last is the block of
 * the alarm (nc_alarm::source). An interrupt program counts as called by the block that it interrupted. When nc_inputs::alarm has stopped a
 * program, the blocks lead to the one that was in execution then, until reset; the host itself knows the text of that alarm. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param calls receives the first `capacity` of these blocks
 * @param capacity elements of `calls`; NC_MAX_CALLS are always enough
 * @return the number of blocks, at most `capacity`; 0 when there is no alarm, it has not stopped a program, or its block is not known
 */
NC_API unsigned nc_alarm_calls_get(const nc_control* control, unsigned system, nc_source* calls, unsigned capacity);

/**
 * Modal snapshot of a mark. Snapshots stay readable for at least `look_ahead` marks. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param id nc_mark::modal, or nc_outputs::modal
 * @param modal receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: no such snapshot, or no longer; NC_E_ARGUMENT: no such part system, a pointer is NULL, or its struct_size
 *         is not valid
 */
NC_API nc_status nc_modal_get(const nc_control* control, unsigned system, uint32_t id, nc_modal* modal);

/**
 * The active G codes of a modal snapshot as text, "G01" "G17" "G54.1", for sinks that print. Any thread.
 * @param control the control
 * @param modal the snapshot
 * @param codes receives the codes in the order of their groups, each with its NUL
 * @param capacity elements of `codes`; NC_GROUPS are enough
 * @return the number of codes; 0 also when a pointer is NULL
 */
NC_API unsigned nc_modal_codes_get(const nc_control* control, const nc_modal* modal, char (*codes)[8], unsigned capacity);

/**
 * Text of a message. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param id nc_action::text, or nc_outputs::message_text
 * @param text receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: no such text, or no longer; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_text_get(const nc_control* control, unsigned system, uint32_t id, nc_text* text);

/**
 * Name of a dialect, as it is written in configurations and command lines. Any thread; needs no control.
 * @param dialect the controller family
 * @return "m700", "dgshape", ...: small letters, constant; NULL: there is no such dialect
 */
NC_API const char* nc_dialect_name(nc_dialect dialect);

/**
 * The dialect of a control, as it was configured. Any thread.
 * @param control the control; NULL: the dialect that nc_config_init() writes
 * @return the controller family
 */
NC_API nc_dialect nc_control_dialect(const nc_control* control);

/**
 * Whose programs a dialect reads, in one short English line ("TurboTek HX, machining centre"). Any thread; needs no control.
 * @param dialect the controller family
 * @return constant text; NULL: there is no such dialect
 */
NC_API const char* nc_dialect_title(nc_dialect dialect);

/**
 * The dialect with a name, the reverse of nc_dialect_name(). Any thread; needs no control.
 * @param name as nc_dialect_name() gives it; small letters
 * @param dialect receives the controller family
 * @return NC_OK; NC_E_NOT_FOUND: no dialect has this name; NC_E_ARGUMENT: a pointer is NULL
 */
NC_API nc_status nc_dialect_get(const char* name, nc_dialect* dialect);

/** What a G or M code is for, as far as a host has to tell codes apart. */
typedef enum nc_code_role {
  NC_CODE_OTHER = 0,           /**< none of those below, or no code of the dialect */
  NC_CODE_PROGRAM_STOP = 1,
  NC_CODE_OPTIONAL_STOP = 2,
  NC_CODE_PROGRAM_END = 3,
  NC_CODE_CALL = 4,            /**< calls a sub program by its number or name: M98 */
  NC_CODE_RETURN = 5,          /**< returns from a sub program */
  NC_CODE_SPINDLE_FORWARD = 6, /**< this code and the next three are given out to the machine */
  NC_CODE_SPINDLE_REVERSE = 7,
  NC_CODE_SPINDLE_STOP = 8,
  NC_CODE_TOOL_CHANGE = 9,
  NC_CODE_DWELL = 10,
  NC_CODE_DATA_INPUT = 11,     /**< the words of its block are data for tables or parameters: G10 */
  NC_CODE_MACRO_CALL = 12,     /**< the words of its block are arguments: G65, G66, G66.1 */
  NC_CODE_CALL_EXTERNAL = 13,  /**< calls a sub program of an external device: M198 */
  NC_CODE_INTERRUPT = 14       /**< names the program that an interrupt calls: M96 */
} nc_code_role;

/**
 * What a code is for. Any thread; needs no control.
 * @param dialect the controller family
 * @param letter its address, 'G' or 'M'
 * @param number M: the code; G: times 10, as in nc_modal::code (G54.1 = 541)
 * @return its role; NC_CODE_OTHER also when an argument is not valid
 */
NC_API nc_code_role nc_code_role_get(nc_dialect dialect, char letter, uint32_t number) NC_RT;

/** A word of a block as it is written, for hosts that look at the text of a program. */
typedef struct nc_plain_word {
  char letter;          /**< its address, a capital */
  bool comma;           /**< a comma stands before it */
  double value;         /**< its number as written */
} nc_plain_word;

/** What kind of number a word has, as far as its decimal point makes a difference. */
typedef enum nc_number_kind {
  NC_NUMBER_OTHER = 0,  /**< none of those below */
  NC_NUMBER_LENGTH = 1, /**< a position, a length or an angle of an axis: parameters decide what unit it has without a decimal point (M700 5.3) */
  NC_NUMBER_DWELL = 2   /**< the time of a dwell, whose decimal point a parameter may make ignored (M700 8.1) */
} nc_number_kind;

/**
 * Tell which kind each number of a block is, from the codes of this block. Modes set by earlier blocks do not count, with one exception: blocks
 * between the beginning and the end of parameter input are data. Any thread; needs no control.
 * @param dialect the controller family
 * @param axes letters of the machine's axes, ended by a NUL
 * @param words the words of the block, in their order
 * @param count number of words
 * @param data before the call: this block stands in parameter input (false for the first block of a program); after it: the next block does
 * @param kinds receives `count` elements, an nc_number_kind for each word
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_number_kinds(nc_dialect dialect, const char* axes, const nc_plain_word* words, unsigned count, bool* data, uint8_t* kinds);

/** One row of a dialect's function table, for documentation and HMIs. */
typedef struct nc_function {
  NC_STRUCT_SIZE(nc_function); /**< see NC_STRUCT_SIZE */
  char code[8];         /**< "G02.1", "M98" */
  uint8_t group;        /**< modal group, 0 = the code acts in its own block only */
  bool supported;       /**< false: a block that uses the code stops with `alarm` */
  const char* part;     /**< which part of a supported function does not work; NULL = no such part is known */
  char alarm[16];       /**< alarm of a function that is not supported */
  const char* name;     /**< short English name */
  const char* section;  /**< section of the manual */
} nc_function;

/**
 * One row of a dialect's function table. Any thread; needs no control.
 * @param dialect the controller family
 * @param index of the row, from 0
 * @param row receives it; its texts are constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid, or the struct_size of `row`
 */
NC_API nc_status nc_function_row(nc_dialect dialect, unsigned index, nc_function* row);

/** System variables that a host can ask for by what they do. */
typedef enum nc_variable_role {
  NC_VARIABLE_OTHER = 0,       /**< none of those below */
  NC_VARIABLE_INPUT_BIT = 1,   /**< each variable is one bit of the macro interface inputs; 32 variables are one word */
  NC_VARIABLE_INPUT_WORD = 2,  /**< each variable is one word of the macro interface inputs */
  NC_VARIABLE_OUTPUT_BIT = 3,  /**< each variable is one bit of the macro interface outputs; 32 variables are one word */
  NC_VARIABLE_OUTPUT_WORD = 4, /**< each variable is one word of the macro interface outputs */
  NC_VARIABLE_SPEED_CODE = 5,  /**< a name by which the machine asks for the S code; programs have no such variable */
  NC_VARIABLE_SPINDLE_SPEED = 6 /**< a name by which the machine asks for the speed that the spindle is wanted at, r/min; programs have no such variable */
} nc_variable_role;

/** One range of system variables (M700 13.5.5), for documentation and HMIs. */
typedef struct nc_system_variable {
  NC_STRUCT_SIZE(nc_system_variable); /**< see NC_STRUCT_SIZE */
  uint32_t first, last; /**< first and last variable number of the range */
  uint8_t role;         /**< nc_variable_role */
  uint8_t word;         /**< macro interface: the word, 0 to NC_WORDS - 1, that the first number belongs to */
  bool readable, writable; /**< whether a program can read such a variable, and write it */
  uint32_t sync;        /**< nc_sync_what bits: a block that reads the variable waits until everything before it has been executed; 0 = the block is
                             read ahead like any other */
  const char* unit;     /**< unit or values, as text */
  const char* name;     /**< short English name */
  const char* section;  /**< section of the manual */
} nc_system_variable;

/**
 * One row of a dialect's table of system variables. Any thread; needs no control.
 * @param dialect whose table
 * @param index of the row, from 0
 * @param row receives it; its texts are constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid, or the struct_size of `row`
 */
NC_API nc_status nc_system_variable_row(nc_dialect dialect, unsigned index, nc_system_variable* row);

/** One parameter, or a row of parameters, that has an effect in the control; for documentation and HMIs. */
typedef struct nc_parameter {
  NC_STRUCT_SIZE(nc_parameter); /**< see NC_STRUCT_SIZE */
  const char* key;            /**< of one with a name of its own ("UNIT*10"), NULL = it has numbers */
  uint32_t first, last, step; /**< numbers: one, or several with the same meaning for one thing after the other */
  int8_t bit;                 /**< of the parameter, -1 = all of it */
  bool by_axis;               /**< may differ from axis to axis */
  const char* values;         /**< unit or possible values; the value that holds while the parameter is not set comes first; words are separated by
                                   "|" */
  const char* name;           /**< short English name */
  const char* section;        /**< section of the manual */
} nc_parameter;

/**
 * One row of the parameter table of a dialect. Any thread; needs no control.
 * @param dialect the controller family
 * @param index of the row, from 0
 * @param row receives it; its texts are constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid, or the struct_size of `row`
 */
NC_API nc_status nc_parameter_row(nc_dialect dialect, unsigned index, nc_parameter* row);

/**
 * Tell whether a parameter has an effect in the control. One without is kept for programs that read it, and does nothing else. Any thread; needs
 * no control.
 * @param dialect the controller family
 * @param key "1084", "1229/bit2", "UNIT*10"
 * @return true when it has an effect
 */
NC_API bool nc_parameter_used(nc_dialect dialect, const char* key);

/**
 * One row of a dialect's alarm table. Any thread; needs no control.
 * @param dialect the controller family
 * @param index of the row, from 0
 * @param code receives the code, as in nc_alarm::code
 * @param message receives the manual's short text, which is constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_alarm_row(nc_dialect dialect, unsigned index, char code[16], const char** message);

/** Alarms of a family that a host finds, not the control. */
typedef enum nc_alarm_role {
  NC_ALARM_PRINTER = 0 /**< what a program prints (NC_ACTION_MESSAGE) does not arrive */
} nc_alarm_role;

/**
 * The alarm that a dialect has for something that a host finds. Any thread; needs no control.
 * @param dialect whose alarm
 * @param role what has been found
 * @param code receives it as nc_alarm::code has it
 * @param message receives the manual's short text, which is constant
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_alarm_role_get(nc_dialect dialect, nc_alarm_role role, char code[16], const char** message);

/**
 * Version of the library. Any thread; needs no control.
 * @return "0.1.0", constant
 */
NC_API const char* nc_version(void);

#ifdef __cplusplus
}
#endif
#endif
