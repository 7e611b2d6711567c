// SPDX-License-Identifier: Apache-2.0
// The terminal while a page fills it, and the part of a page that is shown there.
#pragma once

#include <sys/ioctl.h>
#include <termios.h>

#include <cstddef>
#include <string>

namespace nc::dds {

// The page from line *line on. When the page has fewer lines, *line becomes 0 and the whole page is returned.
std::string from_line(const std::string& page, std::size_t* line);

// The part of a page that fits, with the control codes that write it over the previous contents of the terminal. The last row stays free.
std::string fitted(const std::string& page, unsigned rows, unsigned columns);

// Switches to the alternate screen without echo. The destructor restores the terminal.
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
