// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hogel/export.h"

namespace hogel {

/// The word that a mistyped one was probably meant to be: the nearest by insertions, deletions, replacements and swaps
/// of letters, of which there may be one for every three letters (and one at least); otherwise the first that begins
/// with its three or more letters; otherwise an empty text. The first of several that are equally near.
HOGEL_API std::string nearest_word(std::string_view word, std::span<const std::string> words);

/// Throws Error(usage): there is no `kind` ("renderer") of that name. The message says which one may have been meant,
/// and which ones exist.
[[noreturn]] HOGEL_API void throw_unknown(std::string_view kind, std::string_view name,
                                          std::span<const std::string> known);

/// Throws Error(usage): there is a `kind` of that name already.
[[noreturn]] HOGEL_API void throw_known(std::string_view kind, std::string_view name);

/// Everything of one kind that exists, by name: renderers, coders, scenes. The library fills each table; a program may
/// add rows while it runs, from any thread. A row has a member `name`. References to rows stay valid.
template <class Row>
class Table {
  public:
    /// @param kind  what a row is, in the singular: "renderer"
    Table(std::string kind, std::vector<Row> rows) : kind_(std::move(kind)) {
        for (Row& row : rows) rows_.push_back(std::move(row));
    }

    /// All rows, in the order in which to show them; added ones come last.
    std::vector<Row> rows() const {
        const std::lock_guard lock(mutex_);
        return {rows_.begin(), rows_.end()};
    }
    std::vector<std::string> names() const {
        const std::lock_guard lock(mutex_);
        std::vector<std::string> names;
        for (const Row& row : rows_) names.emplace_back(row.name);
        return names;
    }
    /// The row of that name, or null.
    const Row* look_up(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        for (const Row& row : rows_)
            if (row.name == name) return &row;
        return nullptr;
    }
    /// The row of that name. Throws Error(usage) for an unknown name, with the nearest one and all that exist.
    const Row& find(std::string_view name) const {
        if (const Row* row = look_up(name)) return *row;
        throw_unknown(kind_, name, names());
    }
    /// Adds a row. Throws Error(usage) where the name is taken.
    void add(Row row) {
        const std::lock_guard lock(mutex_);
        for (const Row& other : rows_)
            if (other.name == row.name) throw_known(kind_, row.name);
        rows_.push_back(std::move(row));
    }

  private:
    std::string kind_;
    mutable std::mutex mutex_;
    std::deque<Row> rows_;
};

}  // namespace hogel
