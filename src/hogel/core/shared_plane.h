// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstddef>
#include <utility>

#include "hogel/core/paged_array.h"
#include "hogel/team.h"

namespace hogel::core {

/// Lines [first, first + count) of a plane.
struct LineRange {
    std::size_t first = 0, count = 0;
    std::size_t end() const { return first + count; }
};

/// The lines of one of several processes: about equally many, in groups of `together`.
LineRange lines_of(std::size_t process, std::size_t processes, std::size_t lines, std::size_t together);

/// A plane of complex numbers that is transformed along rows and along columns in turn. Alone, a process has it in one
/// array. The processes of a team have parts, first rows and then columns or the other way round, and send each other
/// what crosses: none of them needs memory for more than two parts. Each process works on its own lines.
class SharedPlane {
  public:
    /// The number of rows may differ before and after the columns are transformed.
    /// @param rows           the larger of both
    /// @param rows_together  rows that a process has together, as far as the last ones allow
    SharedPlane(std::size_t rows, std::size_t columns, std::size_t rows_together, std::size_t columns_together,
                const ScratchOptions& scratch, Team* team = hogel::team());

    LineRange own_rows(std::size_t rows) const { return lines_of(rank_, size_, rows, rows_together_); }
    LineRange own_columns() const { return lines_of(rank_, size_, columns_, columns_together_); }

    /// To be called before the first rows are written.
    void begin_rows(std::size_t rows);
    /// While the plane is in rows: an own row.
    std::complex<float>* row(std::size_t y) { return &now_->view()(y - first_, 0); }
    /// While it is in columns: a place in an own column.
    std::complex<float>& at(std::size_t y, std::size_t x) { return now_->view()(y, x - first_); }

    /// The array of the own rows, which leaves the plane.
    PagedArray take_rows(std::size_t rows) {
        now_->keep_rows(own_rows(rows).count);
        return std::exchange(*now_, PagedArray());
    }

    /// Both wait for all processes, and throw Error(cancelled) if one has failed.
    void to_columns(std::size_t rows);
    void to_rows(std::size_t rows);

  private:
    void reserve(PagedArray& array, std::size_t rows, std::size_t columns) const;
    void turn(std::size_t rows, bool columns);

    Team* team_;
    std::size_t rank_ = 0, size_ = 1;
    std::size_t rows_, columns_, rows_together_, columns_together_;
    ScratchOptions scratch_;
    PagedArray in_rows_, in_columns_;  // alone: the first alone
    PagedArray* now_;
    std::size_t first_ = 0;  // own row or column that is now the array's first
};

/// In the first process, all rows of a plane that the processes of a team have by rows; in others an array without
/// elements. They come in messages that the first one asks for, so that few are under way.
PagedArray gather_rows(Team& team, const PagedArray& own, std::size_t rows, std::size_t rows_together,
                       const ScratchOptions& scratch);

}  // namespace hogel::core
