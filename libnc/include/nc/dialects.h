/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file dialects.h
 * The families of controllers: their names, and their codes, variables, parameters and alarms as tables for documentation and HMIs.
 * Nothing here needs a control.
 * A pointer that is NULL is NC_E_ARGUMENT.
 */
#ifndef NC_DIALECTS_H
#define NC_DIALECTS_H

#include "nc/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- names ---------------------------------------------------------------------------------------------------- */

/**
 * Name of a dialect, as it is written in configurations and command lines. Any thread; needs no control.
 * @param dialect the controller family
 * @return "m700", "dgshape", ...: small letters, constant; NULL: there is no such dialect
 */
NC_API const char* nc_dialect_name(nc_dialect dialect);

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

/* ---- codes and words ------------------------------------------------------------------------------------------ */

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

/** What kind of number a word has, as far as a host that looks at a text has to tell them apart. */
typedef enum nc_number_kind {
  NC_NUMBER_OTHER = 0,  /**< none of those below */
  NC_NUMBER_LENGTH = 1, /**< a position, a length or an angle of an axis: parameters decide what unit it has without a decimal point (M700 5.3) */
  NC_NUMBER_DWELL = 2,  /**< the time of a dwell, whose decimal point a parameter may make ignored (M700 8.1) */
  NC_NUMBER_CODE = 3    /**< a code of the function table (nc_function_row()): G01 */
} nc_number_kind;

/** A word of a block whose number is written there. */
typedef struct nc_plain_word {
  char letter;          /**< its address, a capital */
  bool comma;           /**< a comma stands before it */
  bool point;           /**< its number is written with a decimal point */
  uint8_t kind;         /**< nc_number_kind */
  uint32_t begin, end;  /**< where it is written in the text: from its address to behind its number; both 0 where a block is so long that this is not known */
  double value;         /**< its number as written, in the unit that its word has there (nc_number_kind) */
} nc_plain_word;

/** The most words that a block has. */
#define NC_MAX_WORDS 48

/** What a text shows of a block, for hosts that look at programs without executing them. */
typedef struct nc_block_text {
  NC_STRUCT_SIZE(nc_block_text); /**< see NC_STRUCT_SIZE */
  bool data;            /**< before the call: this block stands in parameter input (false for the first block of a program); after it: the next block does */
  bool fault;           /**< from somewhere on this is no block of the dialect's language; the words in front of it are there */
  uint32_t count;       /**< number of words whose numbers are written there; a word that has a formula, or no number, is none of them */
  size_t used;          /**< bytes from here to the first character of the next block, at least one */
} nc_block_text;

/**
 * Read the words of a block as the dialect reads them, and tell which kind of number each has. The kind comes from the codes of this block. Modes set by earlier
 * blocks do not count, with one exception: blocks between the beginning and the end of parameter input are data. Any thread; needs no control.
 * @param dialect the controller family
 * @param axes letters of the machine's axes, ended by a NUL
 * @param text the program from the first character of the block on
 * @param length of the text, at least 1
 * @param block receives what there is
 * @param words receives the words, in their order; room for NC_MAX_WORDS
 * @return NC_OK; NC_E_ARGUMENT: an argument is not valid, or the struct_size of `block`
 */
NC_API nc_status nc_block_words(nc_dialect dialect, const char* axes, const char* text, size_t length, nc_block_text* block, nc_plain_word* words);

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

/* ---- variables ------------------------------------------------------------------------------------------------ */

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

/* ---- parameters ----------------------------------------------------------------------------------------------- */

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

/* ---- alarms --------------------------------------------------------------------------------------------------- */

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

#ifdef __cplusplus
}
#endif
#endif
