// SPDX-License-Identifier: Apache-2.0
// A program and its setup with their numbers moved.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "permutation.hpp"

namespace nc::permuted {

/**
 * The text of a program for the permuted family. Moved are: numbers of G words (also of one without: G alone is G00), numbers of
 * variables behind '#' and, in "#[ ]", the constants from 1000 on; the parameter that "#100000=" names; P between G10 L50 or L70 and
 * G11. Comments and <names> stay. What a program computes otherwise cannot be seen in its text.
 */
std::string rewritten(const std::string& program, const Dialect& family, const Permutation& permutation);

/// A setup: keys of parameters and the codes and variables that some of them name, variables, sub programs.
nlohmann::ordered_json rewritten(const nlohmann::ordered_json& setup, const Dialect& family, const Permutation& permutation);

}  // namespace nc::permuted
