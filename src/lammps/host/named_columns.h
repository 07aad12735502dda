// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

namespace Shearbox {

// A compute that knows what the columns of its local array are called.
class NamedColumns {
public:
  virtual std::vector<std::string> column_names() const = 0;

protected:
  ~NamedColumns() = default;
};

} // namespace Shearbox
