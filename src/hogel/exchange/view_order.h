// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/exchange/view_set.h"

namespace hogel::exchange {

/// A set whose views are counted by two numbers, of which it is not known which is the column: by options.column_first,
/// or as the parallax says. Along a row of cameras things move sideways. The parallax also says whether rows run from
/// the bottom, if columns run from the left. What was found out is noted.
/// @param set            by the second number for the column, with its size filled in
/// @param first, second  what notes call the numbers: "the first number in the names"
ViewSet ordered_by_parallax(ViewSet set, const ViewImportOptions& options, const std::string& first,
                            const std::string& second);

/// Whether the views of a set, which are taken for several rows, go on moving the same way from the end of a row to the
/// beginning of the next: then they are one row.
bool is_one_row(const ViewSet& set);

/// A set whose views are counted by one number, row by row unless the parallax says column by column; it also says
/// whether every second row (or column) runs back, as the path of a single camera does. What differs from rows that all
/// run the same way is noted. Nothing is changed where options mirror the set.
/// @param set  row by row, with its size filled in
ViewSet unwound_by_parallax(ViewSet set, const ViewImportOptions& options);

}  // namespace hogel::exchange
