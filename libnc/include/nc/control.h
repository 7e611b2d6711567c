/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file control.h
 * Create and configure a control, give it programs, set its tables.
 *
 * Threads: unless a function says otherwise it belongs to the *feeder* thread (one thread, the one that calls nc_feed() or
 * nc_pull()). Only functions marked NC_RT belong to the scan thread. Two different controls never share anything.
 * Ownership: everything lives in the memory given to nc_create(); pointers returned are valid as long as the control.
 */
#ifndef NC_CONTROL_H
#define NC_CONTROL_H

#include "nc/item.h"
#include "nc/vendor.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One axis. Zero means "no limit" for the limits, so a control that only traces needs a name and nothing else. Limits are at most 1e12, places
 *  between -1e9 and 1e9. */
typedef struct nc_axis_config {
  char name;               /**< address letter, A B C U V W X Y Z */
  bool rotary;             /**< degrees instead of mm */
  double rapid;            /**< rapid traverse rate, mm/s or deg/s; 0 = max_velocity */
  double max_velocity;     /**< mm/s or deg/s, also the cutting feed clamp of the axis */
  double max_acceleration; /**< mm/s^2 or deg/s^2 */
  double max_jerk;         /**< mm/s^3 or deg/s^3 */
  double in_position;      /**< in-position width, mm or deg */
  bool soft_limited;       /**< the two limits below hold */
  double soft_min, soft_max; /**< stored stroke limits, machine coordinates */
  double reference[4];     /**< 1st to 4th reference position, machine coordinates */
  uint8_t spindle;         /**< number of the spindle that is this axis while its servo is on (M700 10.5: C axis; rotary), 0 = none */
  double reserved[8];      /**< for members of later versions, must be 0 */
} nc_axis_config;

/** One part system. */
typedef struct nc_system_config {
  uint8_t axis_count;      /**< 1..NC_MAX_AXES */
  nc_axis_config axis[NC_MAX_AXES];
  uint8_t spindle_count;   /**< 1..NC_MAX_SPINDLES; 0 = one */
  uint64_t spindle_unsigned; /**< bit n: nc_inputs::spindle[n] is measured without a sign, so that threads do not ask which way it turns */
  double reserved[7];      /**< for members of later versions, must be 0 */
} nc_system_config;

/** How the machine moves along the path. */
typedef enum nc_motion_mode {
  NC_MOTION_TRAPEZOID = 0, /**< axis velocity and acceleration; jerk is not limited. What a config of zeros chooses: it asks for the fewest limits and the least memory */
  NC_MOTION_OPTIMAL = 1    /**< the least time that keeps velocity, acceleration and jerk of every axis; each axis needs all three */
} nc_motion_mode;

/** Common variables that a machine has beside those of its option, for example #400 to #499. */
typedef struct nc_variable_range {
  uint32_t first, last;    /**< 34 to 999999, at most 10000 of them; both 0 = none */
} nc_variable_range;

/** What a control is. Fill with nc_config_init(), then change what differs. */
typedef struct nc_config {
  NC_STRUCT_SIZE(nc_config); /**< see NC_STRUCT_SIZE; set by nc_config_init() */
  uint8_t dialect;         /**< nc_dialect */
  uint8_t system_count;    /**< 1..NC_MAX_SYSTEMS */
  nc_system_config system[NC_MAX_SYSTEMS];
  double cycle_s;          /**< servo cycle, s, 1e-6..0.1; default 0.001 */
  uint32_t look_ahead;     /**< records in the ring between feeder and scan, power of two 64..65536; default 1024 (15 MB).
                                In the time-optimal mode short lines run at full speed only while those that are in the ring, two records each,
                                are together longer than the way that the machine needs to stop: 16384 (89 MB) for lines of 1 um */
  uint32_t programs;       /**< entries of the program store, 1..65535; default 256 */
  uint32_t tool_offsets;   /**< sets of tool data, 1..999; default 200 */
  uint32_t work_offsets;   /**< n of G54.1 P1..Pn, 0..300; default 96 */
  uint32_t variable_sets;  /**< common variables by option, 100 200 300 600 (M700 13.4); default 600 */
  bool extended_variables; /**< #900000-#907399 of later models; default false */
  uint32_t window_bytes;   /**< text window per part system, 512..16777216; default 65536 */
  double max_feed_override; /**< largest value of nc_inputs::feed_override, 1..10; default 2.0 */
  uint8_t motion_mode;     /**< nc_motion_mode; default NC_MOTION_TRAPEZOID (ncrtd and ncsim choose NC_MOTION_OPTIMAL where every axis has all limits) */
  double path_tolerance;   /**< NC_MOTION_OPTIMAL: lines leave the programmed path by this at most, mm, 1e-5..10;
                                0: not at all, with a rest at each corner; default 0.01. NC_MOTION_TRAPEZOID: by which high-accuracy control rounds corners */
  nc_variable_range variable_ranges[NC_VARIABLE_RANGES]; /**< shared by all part systems; apart from one another, from those of the options
                                and from local and system variables */
  const nc_vendor_code* vendor_codes; /**< the vendor's own codes, `vendor_code_count` rows; copied by nc_create(). NULL = none */
  uint32_t vendor_code_count;         /**< 0 to NC_MAX_VENDOR_CODES */
  nc_alarm_text alarm_text;           /**< texts of the host's in the place of the library's; NULL = none */
  void* alarm_text_user;              /**< handed to `alarm_text` */
  const nc_kinematics* kinematics[NC_MAX_SYSTEMS]; /**< joints behind the axes of each part system; copied by nc_create(). NULL = the axes are what moves */
} nc_config;

/**
 * Set every member to its default: M700, one part system with X Y Z without limits. Any thread. Who cannot use the inline function
 * nc_config_init() (another language) calls this one.
 * @param config receives the defaults; NULL does nothing
 * @param struct_size bytes that `config` has, sizeof(nc_config)
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
  char field[64];          /**< as C writes it: "system[0].axis[2].max_velocity" */
  char reason[160];        /**< what it has to be: "must be 0 to 1e12 mm/s or deg/s; 0 = no limit" */
} nc_config_fault;

/**
 * Whether nc_create() takes a configuration. Any thread; needs no control.
 * @param config the configuration
 * @param fault receives the first member that is refused; untouched when there is none. May be NULL.
 * @return NC_OK; NC_E_ARGUMENT when a member is refused, or `config` is NULL (then *fault is untouched)
 */
NC_API nc_status nc_config_check(const nc_config* config, nc_config_fault* fault);

/**
 * Whether nc_config::variable_ranges[index] can be had. Any thread; needs no control.
 * @param config the configuration with its options and other ranges
 * @param index of the range, 0 to NC_VARIABLE_RANGES - 1
 * @param taken receives the first number of it that is another variable's already; 0 when the range itself is wrong. May be NULL.
 * @return NC_OK, also for no range; NC_E_ARGUMENT when it cannot be had, or `index` is out of range
 */
NC_API nc_status nc_variable_range_check(const nc_config* config, unsigned index, uint32_t* taken);

/**
 * Bytes that nc_create() needs for a configuration. Any thread.
 * @param config the configuration
 * @return bytes; 0 when it is refused: nc_config_check() says why
 */
NC_API size_t nc_memory_required(const nc_config* config);

/**
 * Build a control in memory of the caller; nothing else is ever allocated. Any thread.
 * @param config the configuration; copied
 * @param memory aligned to 64 bytes, kept by the caller for as long as the control is used; its contents do not matter
 * @param size bytes of it, at least nc_memory_required()
 * @param status receives NC_OK; NC_E_ARGUMENT: the configuration is refused (nc_config_check() says why), or `memory` is NULL or not
 *               aligned; NC_E_MEMORY: `size` is too small. May be NULL.
 * @return the control, or NULL. There is nothing to destroy: when it is no longer used, reuse the memory.
 */
NC_API nc_control* nc_create(const nc_config* config, void* memory, size_t size, nc_status* status);

/* ---- parameters, tables, variables ------------------------------------------------------------------------------ */

/**
 * Set a control parameter by the manual's number or name. Feeder thread.
 * @param control the control
 * @param system part system, from 0; a parameter that all have in common (M700 #1121, #1129, #1303, #1304, #8105) is set for all of them, whichever
 *             one is named
 * @param key  "1078", "1267/bit0", "UNIT*10", DGSHAPE "interpretation", ...; a number that the dialect has but that changes nothing here
 *             is accepted and kept
 * @param axis name of the axis of a parameter that is each axis's own, 0 = all axes
 * @param text value as text, in the manual's units: a number, or a word of the manual ("B" for #1003)
 * @return NC_OK; NC_E_NOT_FOUND: no such key; NC_E_ARGUMENT: no such part system or axis, or the value is out of the parameter's range;
 *         NC_E_MEMORY: too many parameters are set
 */
NC_API nc_status nc_parameter_set(nc_control* control, unsigned system, const char* key, char axis, const char* text);

/**
 * Value of a parameter that is a number. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param key  as for nc_parameter_set()
 * @param axis name of the axis, 0 = the value for all axes
 * @param value receives it, in the manual's units; 0 when it was never set
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_parameter_get(const nc_control* control, unsigned system, const char* key, char axis, double* value);

/** Parameters that a host asks for by what they do. */
typedef enum nc_parameter_role {
  NC_PARAMETER_DECIMAL_TYPE_2 = 0,   /**< a number without a point is in mm (M700 5.3) */
  NC_PARAMETER_DWELL_POINT = 1,      /**< the point of P of a dwell counts (M700 8.1) */
  NC_PARAMETER_TOOL_MEMORY = 2,      /**< memory type of tool offsets, 1 or 2 (M700 12.1) */
  NC_PARAMETER_POWER_OFF_CLEARS = 3, /**< power off clears the common variables from #100 on (M700 13.4) */
  NC_PARAMETER_DIGIT_FEED = 4        /**< speed of the feed of one digit 1; those of 2 and up have the keys behind it (M700 7.3) */
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
 * Read one entry of the work offset tables, as the blocks have left it that were read so far. Feeder thread.
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
 * Set one entry of the tool offset table, which all part systems have in common. Feeder thread.
 * @param control the control
 * @param number of the set, 1 to nc_config::tool_offsets
 * @param column nc_tool_column
 * @param value mm, between -1e9 and 1e9
 * @return NC_OK; NC_E_ARGUMENT: no such set or column, or the value is out of range
 */
NC_API nc_status nc_tool_offset_set(nc_control* control, unsigned number, nc_tool_column column, double value);

/**
 * Read one entry of the tool offset table, as the blocks have left it that part system 0 has read and the others have executed. Feeder thread.
 * @param control the control
 * @param number of the set, 1 to nc_config::tool_offsets
 * @param column nc_tool_column
 * @param value receives it, mm
 * @return NC_OK; NC_E_ARGUMENT: no such set or column, or `value` is NULL
 */
NC_API nc_status nc_tool_offset_get(const nc_control* control, unsigned number, nc_tool_column column, double* value);

/**
 * Set a local or common variable. Feeder thread.
 * @param control the control
 * @param system part system, from 0; a variable that they share is set for all of them, whichever one is named
 * @param number of the variable; local ones are those of the program that is being read
 * @param value its value, finite
 * @param vacant true: it becomes vacant (#0), and `value` does not count
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or `value` is no finite number; NC_E_NOT_FOUND: no such variable, or a system variable
 */
NC_API nc_status nc_variable_set(nc_control* control, unsigned system, uint32_t number, double value, bool vacant);

/**
 * Read a local or common variable, as the blocks of this part system have left it that were read so far; of a shared one also as the executed blocks of the others have. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param number of the variable; local ones are those of the program that is being read
 * @param value receives its value
 * @param vacant receives whether it is vacant (#0)
 * @return NC_OK; NC_E_ARGUMENT: no such part system, or a pointer is NULL; NC_E_NOT_FOUND: no such variable, or a system variable
 */
NC_API nc_status nc_variable_get(const nc_control* control, unsigned system, uint32_t number, double* value, bool* vacant);

/**
 * First parameter from place `from` on that is set. The places are numbered in the order in which the parameters were first set. A parameter of
 * which one bit was set ("1267/bit0") is given whole; one whose setting has been taken back is left out. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param from place at which the search begins, from 0
 * @param place receives its place: go on with one more
 * @param key receives its key
 * @param axis receives the name of its axis, 0 = all axes
 * @param value receives its value when it is a number or one character, in the manual's units
 * @param text receives it when it is of two characters or more, at most 63; else ""
 * @return NC_OK; NC_E_NOT_FOUND: there is none; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_parameter_next(const nc_control* control, unsigned system, unsigned from, unsigned* place, char key[24], char* axis,
                                   double* value, char text[64]);

/**
 * Notes about the parameters that are set, one sentence each: which of them have no effect on this machine, and where a time constant limits the
 * speed and not the feed (docs/motion.md, "Behind interpolation"). In the order of the parameters' numbers, then of the axes. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param index of the sentence, from 0
 * @param text receives it, cut to `size` bytes with its NUL; 200 are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_NOT_FOUND: behind the last one; NC_E_ARGUMENT: no such part system, or no room
 */
NC_API nc_status nc_parameter_note_row(const nc_control* control, unsigned system, unsigned index, char* text, size_t size);

/**
 * Called by nc_look_executed() while variables, their names, offsets and parameters are as those blocks have left them that the machine has
 * executed: this is what is to be kept while the power is off. Behind the call they are again as the blocks have left them that
 * were read ahead. It only reads. Feeder thread.
 * @param user what nc_look_executed() was given
 * @param control the control
 */
typedef void (*nc_look)(void* user, const nc_control* control);

/**
 * Call `look` while the tables are as the executed blocks have left them (see nc_look). Feeder thread.
 * @param control the control
 * @param look called once, before this function returns
 * @param user handed to it
 */
NC_API void nc_look_executed(nc_control* control, nc_look look, void* user);

/**
 * First common variable with a number from `from` on that is not vacant. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param from number at which the search begins
 * @param number receives its number: go on with one more
 * @param value receives its value
 * @return NC_OK; NC_E_NOT_FOUND: there is none; NC_E_ARGUMENT: no such part system, or a pointer is NULL
 */
NC_API nc_status nc_variable_next(const nc_control* control, unsigned system, uint32_t from, uint32_t* number, double* value);

/**
 * A hash over all that a program can go by, behind the blocks that were read so far: modes and the words in force, the place in the program and
 * in those that have called it, position, variables, offsets, parameters, outputs. A program that comes to the same place with the same hash, without having been
 * given anything else from outside meanwhile (clock, inputs, a write of the host's), goes on for ever. It looks at every table: for now and then,
 * not for every block. The number means nothing to another version of the library. Feeder thread.
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
 * @return bytes read; 0 at the end; negative on failure: NC_READ_FAILED, or NC_READ_CHANGED. Either becomes an alarm on the block that
 *         needed it; nothing of what is in `buffer` then acts.
 */
typedef long (*nc_read_at)(void* user, uint64_t offset, char* buffer, size_t size);

/** The text cannot be read (any negative number but the one below means the same). */
#define NC_READ_FAILED (-1L)
/** The text is no longer the one that was entered: somebody has written into its file. */
#define NC_READ_CHANGED (-2L)

/**
 * Enter a text into the program store. It is read in windows, never whole, and again wherever a program jumps: the text behind `read`
 * must stay unchanged from here until its entry is replaced or removed. What comes from a file, which anybody may overwrite meanwhile, is
 * therefore copied by the host, or watched: this library's own hosts (ncrtd, ncsim) keep a copy of a file of up to 16 MiB, and of a
 * larger one compare size, time, place and a hash of each part with what they were; their `read` then gives NC_READ_CHANGED.
 * Feeder thread.
 * @param control the control
 * @param name file name without folder, at most NC_MAX_NAME - 1 bytes; "O1000", "1000", "1000.nc" make it program 1000 even when the text
 *             has no O line. Copied. An entry of the same name is replaced.
 * @param read gives pieces of the text, in the feeder thread
 * @param user handed to `read`
 * @param size bytes of the text
 * @param file receives its index (nc_source::file), from 0. May be NULL.
 * @return NC_OK; NC_E_ARGUMENT: no name, or too long, or `read` is NULL; NC_E_STATE: the entry of this name runs (online) or is protected
 *         (M700 #8105: O8000 to O9999, #1121: O9000 to O9999); NC_E_MEMORY: all places (nc_config::programs) are taken,
 *         nc_program_remove() frees one. MDI needs none of them.
 */
NC_API nc_status nc_program_add(nc_control* control, const char* name, nc_read_at read, void* user, uint64_t size, unsigned* file);

/**
 * Enter a text that lies in memory into the program store. Feeder thread.
 * @param control the control
 * @param name as for nc_program_add()
 * @param text the text, kept and not changed by the caller for as long as its entry is there
 * @param length bytes of it
 * @param file receives its index, from 0. May be NULL.
 * @return as nc_program_add()
 */
NC_API nc_status nc_program_add_text(nc_control* control, const char* name, const char* text, size_t length, unsigned* file);

/** What a place of the program store holds. */
typedef struct nc_program_info {
  NC_STRUCT_SIZE(nc_program_info); /**< see NC_STRUCT_SIZE */
  char name[NC_MAX_NAME];
  uint32_t number;      /**< O number of the name, 0 = none */
  uint64_t size;        /**< bytes of the text */
  uint64_t used;        /**< grows in the control with each entry, selection and call: the place with the largest number was used last */
  bool in_use;          /**< something refers to it: see nc_program_remove() */
  bool is_protected;    /**< M700 #8105, #1121 */
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
 * Take a text out of the program store: nothing of it is read any more, and its index may come back for another one. Feeder thread.
 * @param control the control
 * @param file its index
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_STATE while something refers to it: it is selected in a part system, in a call
 *         stack (also one that comes back when blocks that were read ahead are taken back), the program of a modal call or of the macro
 *         interrupt; or it is protected; NC_E_ARGUMENT: `control` is NULL
 */
NC_API nc_status nc_program_remove(nc_control* control, unsigned file);

/**
 * Asked when a sub program is not in the store: the host may add it with nc_program_add() from inside this call. Feeder thread.
 * @param user what nc_program_on_missing() was given
 * @param control the control
 * @param name "O1000" or the name between < >; for M198 with "198:" before it, for M98 ,D1 to ,D4 with "D1:" to "D4:". To be added under this name.
 * @return true when it has been added.
 */
typedef bool (*nc_program_missing)(void* user, nc_control* control, const char* name);

/**
 * Say whom to ask for sub programs that are not in the store. Feeder thread.
 * @param control the control
 * @param callback called in the feeder thread, from inside nc_pull() or nc_feed(); NULL = nobody
 * @param user handed to it
 */
NC_API void nc_program_on_missing(nc_control* control, nc_program_missing callback, void* user);

/**
 * Say that the text of a program is being edited, or no longer is. When it is selected, or called, and begins while it is being edited, it stops with
 * the alarm for that (M700 P235). Feeder thread.
 * @param control the control
 * @param file its index
 * @param editing true: editing begins; false: it has ended
 * @return NC_OK; NC_E_STATE: it runs, or is protected; NC_E_ARGUMENT: the place is free
 */
NC_API nc_status nc_program_edit(nc_control* control, unsigned file, bool editing);

/** What the bytes of a program are. */
typedef enum nc_tape {
  NC_TAPE_NONE,  /**< text, all of it significant */
  NC_TAPE_TEXT,  /**< text with a label in front: up to the first end of block nothing is significant (M700 3.1) */
  NC_TAPE_ISO,   /**< rows of a punched tape with such a label, ISO code R-840: an even number of holes in each row */
  NC_TAPE_EIA    /**< the same in EIA code RS-244: an odd number */
} nc_tape;

/**
 * The program is an image of a tape, one byte for each row, hole 1 its lowest bit. Every row is checked as its block is read, and the
 * number of characters of a block where the parity V parameter of the input device says so (M700 3.6: #9115 to #9515). A program that
 * runs from a tape cannot jump. Feeder thread.
 * @param control the control
 * @param file its index
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
 * @return NC_OK; NC_E_NOT_FOUND: the place is free; NC_E_STATE: a program runs; NC_E_ARGUMENT: no such part system
 */
NC_API nc_status nc_program_select(nc_control* control, unsigned system, unsigned file);

/**
 * Give the blocks of an MDI program and select it. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param text the blocks; copied
 * @param length bytes of it, at most 1024
 * @return NC_OK; NC_E_STATE: a program runs; NC_E_ARGUMENT: no such part system, or too long
 */
NC_API nc_status nc_mdi_load(nc_control* control, unsigned system, const char* text, size_t length);

/* ---- state ------------------------------------------------------------------------------------------------------ */

/**
 * Put the machine at a place while nothing runs; all axes count as referenced. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param machine machine coordinates, mm or deg, between -1e9 and 1e9; copied
 * @return NC_OK; NC_E_STATE: a program runs; NC_E_ARGUMENT: no such part system, or a place is out of range
 */
NC_API nc_status nc_position_set(nc_control* control, unsigned system, const nc_axes* machine);

/**
 * Turn positions into what the counters show: machine coordinates of rotary axes of #8213 = 0, 1 and 2, and workpiece coordinates of
 * #8213 = 0 and 1, as 0 <= angle < 360 (M700 14.13). In items, events and set-points such an axis counts on over its turns. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param machine machine coordinates, mm or deg; what it holds is turned into what is shown. May be NULL.
 * @param work workpiece coordinates in the same way. May be NULL.
 */
NC_API void nc_position_shown(const nc_control* control, unsigned system, nc_axes* machine, nc_axes* work);

/**
 * Name of a common variable (SETVN; M700 13.5.5). Feeder thread.
 * @param control the control
 * @param number of the variable
 * @param name receives it with its NUL; "" = none
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL
 */
NC_API nc_status nc_variable_name_get(const nc_control* control, uint32_t number, char name[8]);

/**
 * Give a common variable a name that was kept while the power was off. Feeder thread.
 * @param control the control
 * @param number of the variable, 500 to 519
 * @param name at most 7 capital letters and digits, a letter first; "" takes it away. Copied.
 * @return NC_OK; NC_E_ARGUMENT: the variable can have no name, or the name is not a valid one
 */
NC_API nc_status nc_variable_name_set(nc_control* control, uint32_t number, const char* name);

/**
 * Reads a device of the PLC for #100110 (M700 13.5.5). Feeder thread.
 * @param user what nc_device_on_read() was given
 * @param code kind of device, of the manual's table
 * @param number of the device
 * @param value receives 0 or 1 of a bit device, 16 bits of a word device
 */
typedef void (*nc_device_read)(void* user, unsigned code, uint32_t number, uint32_t* value);

/**
 * Say whom to ask for devices of the PLC. Without a callback the devices do not exist (P39). Feeder thread.
 * @param control the control
 * @param callback called in the feeder thread; NULL = nobody
 * @param user handed to it
 */
NC_API void nc_device_on_read(nc_control* control, nc_device_read callback, void* user);

/**
 * Say how the macro interface outputs (#1132 to #1135) stand at the machine. A program reads this until a block of it writes them; the outputs
 * themselves are not changed. To be called before nc_program_select() or nc_mdi_load(), since blocks that were read ahead already are not read
 * again. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param word 0..3: #1132 to #1135
 * @param mask the bits that are set
 * @param bits their values
 * @return NC_OK; NC_E_ARGUMENT: no such part system or word
 */
NC_API nc_status nc_interface_output_set(nc_control* control, unsigned system, unsigned word, uint32_t mask, uint32_t bits);

/**
 * Macro interface outputs as the interpreter holds them (#1132 to #1135), for sinks; the machine's own image is in nc_outputs.
 * Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param word 0 to NC_WORDS - 1
 * @param bits receives 32 outputs, bit 0 the first
 * @return NC_OK; NC_E_ARGUMENT: no such part system or word, or `bits` is NULL
 */
NC_API nc_status nc_interface_output_get(const nc_control* control, unsigned system, unsigned word, uint32_t* bits);

/**
 * Set the switches that decide before a block is read. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param optional_skip bit n = switch n (1 to 9), bit 1 is the plain '/'
 * @param mirror_axes bit i: the next program, from its head on, is mirrored in axis i about where the axis stands then
 */
NC_API void nc_switches_set(nc_control* control, unsigned system, uint32_t optional_skip, uint32_t mirror_axes);

/**
 * The alarm that stopped a part system, of its program or of the control itself (NC-INTERNAL). Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param alarm receives a copy
 * @return NC_OK; NC_E_NOT_FOUND: there is none (a stop by nc_inputs::alarm is no alarm of the control); NC_E_ARGUMENT: no such part system, a pointer is NULL, or its struct_size is not valid
 */
NC_API nc_status nc_alarm_get(const nc_control* control, unsigned system, nc_alarm* alarm);

/**
 * Short text of an alarm: the host's (nc_config::alarm_text), else that of the dialect's manual. Feeder thread.
 * @param control the control
 * @param code as nc_alarm::code has it
 * @param text receives it, cut to `size` bytes with its NUL; NC_MAX_TEXT are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_NOT_FOUND: neither has a text for it; NC_E_ARGUMENT: a pointer is NULL, or there is no room
 */
NC_API nc_status nc_alarm_text_get(const nc_control* control, const char* code, char* text, size_t size);

/**
 * What a status means: the host's text (nc_config::alarm_text by the name of the status, "NC_E_STATE"), else nc_status_text(). Feeder thread.
 * @param control the control
 * @param status what a call has returned; any other number has a sentence, too
 * @param text receives it, cut to `size` bytes with its NUL; NC_MAX_TEXT are enough
 * @param size bytes of `text`
 * @return NC_OK; NC_E_ARGUMENT: a pointer is NULL, or there is no room
 */
NC_API nc_status nc_status_text_get(const nc_control* control, nc_status status, char* text, size_t size);

/**
 * The blocks that led to that alarm, outermost first: each of them called the program of the next one, the last is the block of the alarm
 * (nc_alarm::source). An interrupt program counts as called by the block that it interrupted. Where nc_inputs::alarm has stopped a program
 * they lead to the block that was in execution then, until reset; the text of that alarm is the host's own. Feeder thread.
 * @param control the control
 * @param system part system, from 0
 * @param calls receives the first `capacity` of them
 * @param capacity elements of `calls`; NC_MAX_CALLS are all
 * @return their number; 0 when there is no alarm, none of a program, or its place is not known
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
 * Active G codes of a snapshot as text, "G01" "G17" "G54.1": for sinks that print. Any thread.
 * @param control the control
 * @param modal the snapshot
 * @param codes receives them in the order of their groups, each with its NUL
 * @param capacity elements of `codes`; NC_GROUPS are enough
 * @return their number; 0 also when a pointer is NULL
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
 * Name of a dialect, as configurations and command lines have it. Any thread; needs no control.
 * @param dialect the controller family
 * @return "m700", "dgshape", ...: small letters, constant; NULL: there is no such dialect
 */
NC_API const char* nc_dialect_name(nc_dialect dialect);

/**
 * Dialect of a name, the reverse of nc_dialect_name(). Any thread; needs no control.
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
  NC_CODE_CALL = 4,            /**< of a sub program by its number: M98, M198 */
  NC_CODE_RETURN = 5,          /**< from a sub program */
  NC_CODE_SPINDLE_FORWARD = 6, /**< goes out to the machine, as the three that follow */
  NC_CODE_SPINDLE_REVERSE = 7,
  NC_CODE_SPINDLE_STOP = 8,
  NC_CODE_TOOL_CHANGE = 9,
  NC_CODE_DWELL = 10,
  NC_CODE_DATA_INPUT = 11,     /**< its words are data for tables or parameters: G10 */
  NC_CODE_MACRO_CALL = 12      /**< the words of its block are arguments: G65, G66, G66.1 */
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
  double value;
} nc_plain_word;

/** What the number of a word is, as far as a decimal point makes a difference. */
typedef enum nc_number_kind {
  NC_NUMBER_OTHER = 0,
  NC_NUMBER_LENGTH = 1, /**< a position, a length or an angle of an axis: without a point in units, by the parameters (M700 5.3) */
  NC_NUMBER_DWELL = 2   /**< the time of a dwell whose point may not count (M700 8.1) */
} nc_number_kind;

/**
 * What the numbers of a block are, by the codes that stand in it. Modes of blocks before do not count, but for one: blocks between the
 * beginning and the end of parameter input are data. Any thread; needs no control.
 * @param dialect the controller family
 * @param axes letters of the machine's axes, with a NUL
 * @param words of the block, in their order
 * @param count of them
 * @param data in: the block stands in parameter input; out: so does the one behind it. false in front of a program.
 * @param kinds receives an nc_number_kind for each word
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_number_kinds(nc_dialect dialect, const char* axes, const nc_plain_word* words, unsigned count, bool* data, uint8_t* kinds);

/** One row of a dialect's function table, for documentation and HMIs. */
typedef struct nc_function {
  NC_STRUCT_SIZE(nc_function);
  char code[8];         /**< "G02.1", "M98" */
  uint8_t group;        /**< modal group, 0 = one-shot */
  bool supported;       /**< false: raises `alarm` when used */
  const char* part;     /**< what of a supported function is not built, NULL = nothing that is known */
  char alarm[16];
  const char* name;     /**< short English name */
  const char* section;  /**< of the manual */
} nc_function;

/**
 * One row of a dialect's function table. Any thread; needs no control.
 * @param dialect the controller family
 * @param index of the row, from 0
 * @param row receives it; its texts are constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid, or the struct_size of `row`
 */
NC_API nc_status nc_function_row(nc_dialect dialect, unsigned index, nc_function* row);

/** System variables that a host asks for by what they do. */
typedef enum nc_variable_role {
  NC_VARIABLE_OTHER = 0,       /**< none of those below */
  NC_VARIABLE_INPUT_BIT = 1,   /**< macro interface inputs, one bit each; 32 numbers a word */
  NC_VARIABLE_INPUT_WORD = 2,  /**< macro interface inputs, one word each */
  NC_VARIABLE_OUTPUT_BIT = 3,  /**< macro interface outputs, in the same way */
  NC_VARIABLE_OUTPUT_WORD = 4
} nc_variable_role;

/** One range of system variables (M700 13.5.5), for documentation and HMIs. */
typedef struct nc_system_variable {
  NC_STRUCT_SIZE(nc_system_variable);
  uint32_t first, last;
  uint8_t role;         /**< nc_variable_role */
  uint8_t word;         /**< macro interface: the word, 0 to NC_WORDS - 1, that the first number belongs to */
  bool readable, writable;
  uint32_t sync;        /**< nc_sync_what: reading waits until everything before has happened; 0 = it is read ahead */
  const char* unit;
  const char* name;     /**< short English name */
  const char* section;  /**< of the manual */
} nc_system_variable;

/**
 * One row of a dialect's table of system variables. Any thread; needs no control.
 * @param dialect whose table
 * @param index of the row, from 0
 * @param row receives it; its texts are constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid, or the struct_size of `row`
 */
NC_API nc_status nc_system_variable_row(nc_dialect dialect, unsigned index, nc_system_variable* row);

/** Parameters that something in the control asks for, for documentation and HMIs. */
typedef struct nc_parameter {
  NC_STRUCT_SIZE(nc_parameter);
  const char* key;            /**< of one with a name of its own ("UNIT*10"), NULL = it has numbers */
  uint32_t first, last, step; /**< numbers: one, or several with the same meaning for one thing after the other */
  int8_t bit;                 /**< of the parameter, -1 = all of it */
  bool by_axis;               /**< may differ from axis to axis */
  const char* values;         /**< unit or values, what holds without it first; words of a parameter are apart by "|" */
  const char* name;           /**< short English name */
  const char* section;        /**< of the manual */
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
 * Whether something in the control asks for a parameter. One that it does not ask for is kept for programs that read it, and does
 * nothing. Any thread; needs no control.
 * @param dialect the controller family
 * @param key "1084", "1229/bit2", "UNIT*10"
 * @return true when it does
 */
NC_API bool nc_parameter_used(nc_dialect dialect, const char* key);

/**
 * One row of a dialect's alarm table. Any thread; needs no control.
 * @param dialect the controller family
 * @param index of the row, from 0
 * @param code receives it as nc_alarm::code has it
 * @param message receives the manual's short text, which is constant
 * @return NC_OK; NC_E_NOT_FOUND: behind the last row; NC_E_ARGUMENT: an argument is not valid
 */
NC_API nc_status nc_alarm_row(nc_dialect dialect, unsigned index, char code[16], const char** message);

/** Alarms of a family that a host finds, not the control. */
typedef enum nc_alarm_role {
  NC_ALARM_PRINTER = 0 /**< what a program prints (NC_ACTION_PRINT) does not arrive */
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
