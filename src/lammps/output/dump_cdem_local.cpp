// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/dump_cdem_local.h"

#include "host/named_columns.h"

#include "compute.h"
#include "modify.h"
#include "utils.h"

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace {

// The name of the field that a word such as c_contacts[7] stands for; the word itself if nobody names it.
std::string name_of(const std::string &word, const Modify &modify) {
  static const std::regex column("c_(.*)\\[([0-9]+)\\]");
  std::smatch part;
  if (!std::regex_match(word, part, column))
    return word;
  for (int i = 0; i < modify.ncompute; i++)
    if (modify.compute[i]->id == part.str(1))
      if (const auto *named = dynamic_cast<Shearbox::NamedColumns *>(modify.compute[i]))
        return named->column_names().at(std::stoi(part.str(2)) - 1); // dump local has seen that there is one
  return word;
}

std::string with_names(const std::string &columns, const Modify &modify) {
  const std::vector<std::string> words = utils::split_words(columns);
  std::vector<std::string> names;
  for (const std::string &word : words)
    names.push_back(name_of(word, modify));
  std::string all;
  for (std::size_t k = 0; k < words.size(); k++)
    all += (k ? " " : "") + (std::count(names.begin(), names.end(), names[k]) == 1 ? names[k] : words[k]);
  return all;
}

} // namespace

// A compute may have been made anew, with other fields, since the last run. LAMMPS puts a blank behind the format of
// every column.
void DumpCDEMLocal::init_style() {
  DumpLocal::init_style();
  if (columns != names)
    words = columns;
  names = with_names(words, *modify);
  delete[] columns;
  columns = utils::strdup(names);
  std::string last = vformat[size_one - 1];
  last.pop_back();
  std::copy_n(last.c_str(), last.size() + 1, vformat[size_one - 1]);
}
