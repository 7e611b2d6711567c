// SPDX-License-Identifier: Apache-2.0
// The terminal while a page fills it, and what of a page is shown there.
#pragma once

#include <sys/ioctl.h>
#include <termios.h>

#include <cstddef>
#include <string>

namespace nc::dds {

// The page from line *line on. Where the page has fewer lines, *line becomes 0 and the page begins at its head.
std::string from_line(const std::string& page, std::size_t* line);

// As much of a page as fits, with the codes that put it over what the terminal showed before. The last row stays free.
std::string fitted(const std::string& page, unsigned rows, unsigned columns);

// The alternate screen without echo; the terminal is as before whatever ends the program in order.
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  static winsize dimensions();
  void show(const std::string& page);
  // The key that was pressed, 0 = none.
  char key() const;

 private:
  termios before_{};
  bool raw_ = false;
};

}  // namespace nc::dds
