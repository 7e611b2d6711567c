// SPDX-License-Identifier: Apache-2.0
// Rewrites a program and its setup with permuted numbers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "permutation.hpp"

namespace nc::permuted {

/**
 * The text of a program for the permuted family. These are permuted: numbers of G words (a G without a number is G00), numbers of variables
 * behind '#' and, in "#[ ]", the constants from 1000 on; the parameter that "#100000=" names; P between G10 L50 or L70 and G11. Comments and
 * <names> stay. Numbers that a program computes in other ways cannot be seen in its text.
 */
std::string rewritten(const std::string& program, const Dialect& family, const Permutation& permutation);

/// The same for a setup: keys of parameters, codes and variables that some of them name, variables, sub programs.
nlohmann::ordered_json rewritten(const nlohmann::ordered_json& setup, const Dialect& family, const Permutation& permutation);

}  // namespace nc::permuted
