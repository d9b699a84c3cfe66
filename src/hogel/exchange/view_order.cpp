// SPDX-License-Identifier: Apache-2.0
#include "hogel/exchange/view_order.h"

#include <fmt/format.h>

#include "hogel/exchange/parallax.h"

namespace hogel::exchange {
namespace {

// Returns whether the motion reverses in every second row, or column, of views.
bool runs_back(const ViewSet& set, bool along_columns) {
    const std::size_t row = (set.rows - 2) / 2, column = (set.columns - 2) / 2;
    const auto shifts = [&](std::size_t r, std::size_t c) {
        return match_blocks(grey_view(set, r, c), grey_view(set, along_columns ? r + 1 : r, along_columns ? c : c + 1),
                            along_columns, max_parallax);
    };
    return move_oppositely(shifts(row, column), along_columns ? shifts(row, column + 1) : shifts(row + 1, column));
}

// Returns whether the parallax is vertical between a view near the middle and the next by number. The pair is chosen to
// be neighbours in row-major and in column-major order.
bool runs_down(const ViewSet& set) {
    const std::size_t n = set.columns, m = set.rows;
    for (std::size_t i = (n * m - 1) / 2; i + 1 < n * m; ++i)
        if ((i + 1) % n != 0 && (i + 1) % m != 0)
            return moves_up_and_down(grey_view(set, i / n, i % n), grey_view(set, (i + 1) / n, (i + 1) % n));
    return false;
}

}  // namespace

bool is_one_row(const ViewSet& set) {
    if (set.rows < 2 || set.columns < 2) return false;
    const std::size_t row = (set.rows - 2) / 2, last = set.columns - 1;
    const Array<float, 2> end = grey_view(set, row, last);
    return move_alike(match_blocks(grey_view(set, row, last - 1), end, false, max_parallax),
                      match_blocks(end, grey_view(set, row + 1, 0), false, max_parallax));
}

ViewSet unwound_by_parallax(ViewSet set, const ViewImportOptions& options) {
    if (options.mirror_columns || options.mirror_rows || set.rows < 2 || set.columns < 2) return set;
    const std::size_t n = set.columns, m = set.rows;
    if (!parallax_of(set).certain)
        set.notes.emplace_back("their parallax does not decide the order of views: they were taken row by row");
    const bool by_columns = runs_down(set);
    if (by_columns) {
        set = reordered(std::move(set), m, n, [=](std::size_t row, std::size_t column) {
            const std::size_t i = column * m + row;
            return std::pair(i / n, i % n);
        });
        set.notes.emplace_back("by their parallax, views are counted column by column");
    }
    if (!runs_back(set, by_columns)) return set;
    set.notes.push_back(
        fmt::format("by their parallax, every second {} of views runs back", by_columns ? "column" : "row"));
    return reordered(std::move(set), m, n, [=](std::size_t row, std::size_t column) {
        if (by_columns) return std::pair(column % 2 == 0 ? row : m - 1 - row, column);
        return std::pair(row, row % 2 == 0 ? column : n - 1 - column);
    });
}

ViewSet ordered_by_parallax(ViewSet set, const ViewImportOptions& options, const std::string& first,
                            const std::string& second) {
    if (options.column_first.value_or(false)) set = transposed(std::move(set));
    ParallaxEvidence evidence = parallax_of(set);
    if (!options.column_first && evidence.certain && evidence.swapped) {
        set = transposed(std::move(set));
        evidence = parallax_of(set);
        set.notes.push_back(fmt::format("by their parallax, {} is the column of views", first));
    } else if (!options.column_first) {
        set.notes.push_back(evidence.certain ? fmt::format("by their parallax, {} is the column of views", second)
                                             : fmt::format("their parallax does not decide the order of views: {} was "
                                                           "taken for the column of views, with rows from the top",
                                                           second));
    }
    if (evidence.certain && evidence.opposed && !options.mirror_columns && !options.mirror_rows) {
        set = mirrored(std::move(set), false, true);
        set.notes.emplace_back("by their parallax, rows of views run from the bottom, if columns run from the left");
    }
    return set;
}

}  // namespace hogel::exchange
