// SPDX-License-Identifier: Apache-2.0
#include "hogel/core/shared_plane.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "hogel/error.h"

namespace hogel::core {
namespace {

using Complex = std::complex<float>;

// Bytes of a message between processes, few so that what is under way takes little memory.
constexpr std::size_t max_message = std::size_t{1} << 20;

// A rectangle of a plane, and the row and column that are the first of an array.
struct Part {
    LineRange rows, columns;
};

std::size_t rows_at_once(const Part& part) {
    return std::max<std::size_t>(1, max_message / (sizeof(Complex) * std::max<std::size_t>(1, part.columns.count)));
}

}  // namespace

LineRange lines_of(std::size_t process, std::size_t processes, std::size_t lines, std::size_t together) {
    const std::size_t groups = (lines + together - 1) / together;
    const auto begin = [&](std::size_t i) { return std::min(lines, i * groups / processes * together); };
    return {begin(process), begin(process + 1) - begin(process)};
}

SharedPlane::SharedPlane(std::size_t rows, std::size_t columns, std::size_t rows_together, std::size_t columns_together,
                         const ScratchOptions& scratch, Team* team)
    : team_(team),
      rows_(rows),
      columns_(columns),
      rows_together_(rows_together),
      columns_together_(columns_together),
      scratch_(scratch),
      now_(&in_rows_) {
    if (team_ != nullptr && team_->size() > 1) {
        rank_ = team_->rank();
        size_ = team_->size();
    }
    if (size_ == 1) in_rows_ = PagedArray({rows, columns}, scratch);
}

void SharedPlane::begin_rows(std::size_t rows) {
    if (size_ == 1) return;
    const LineRange own = own_rows(rows);
    first_ = own.first;
    reserve(*now_, own.count, columns_);
}

// Memory that is there is used again, because the system clears new memory.
void SharedPlane::reserve(PagedArray& array, std::size_t rows, std::size_t columns) const {
    rows = std::max<std::size_t>(rows, 1);
    columns = std::max<std::size_t>(columns, 1);
    if (array.extent(0) < rows || array.extent(1) != columns) array = PagedArray({rows, columns}, scratch_);
}

void SharedPlane::to_columns(std::size_t rows) { turn(rows, true); }
void SharedPlane::to_rows(std::size_t rows) { turn(rows, false); }

void SharedPlane::turn(std::size_t rows, bool columns) {
    if (size_ == 1) return;
    // What this process has of what another gets, and the other way round.
    const auto crossing = [&](std::size_t of_rows, std::size_t of_columns) {
        return Part{lines_of(of_rows, size_, rows, rows_together_),
                    lines_of(of_columns, size_, columns_, columns_together_)};
    };
    PagedArray& next = columns ? in_columns_ : in_rows_;
    const LineRange mine = columns ? own_columns() : own_rows(rows);
    reserve(next, columns ? rows_ : mine.count, columns ? mine.count : columns_);
    const auto place = [&](PagedArray& array, bool by_columns, std::size_t first, std::size_t y, std::size_t x) {
        return by_columns ? &array.view()(y, x - first) : &array.view()(y - first, x);
    };
    const Part kept = crossing(rank_, rank_);
    for (std::size_t y = kept.rows.first; y < kept.rows.end() && kept.columns.count > 0; ++y)
        std::copy_n(place(*now_, !columns, first_, y, kept.columns.first), kept.columns.count,
                    place(next, columns, mine.first, y, kept.columns.first));
    for (std::size_t step = 1; step < size_; ++step) {
        const std::size_t to = (rank_ + step) % size_, from = (rank_ + size_ - step) % size_;
        const Part sent = columns ? crossing(rank_, to) : crossing(to, rank_);
        const Part got = columns ? crossing(from, rank_) : crossing(rank_, from);
        const auto pack = [&](std::size_t y0, std::size_t count) {
            std::string bytes(count * sent.columns.count * sizeof(Complex), '\0');
            for (std::size_t y = 0; y < count && sent.columns.count > 0; ++y)
                std::memcpy(bytes.data() + y * sent.columns.count * sizeof(Complex),
                            place(*now_, !columns, first_, y0 + y, sent.columns.first),
                            sent.columns.count * sizeof(Complex));
            return bytes;
        };
        const auto unpack = [&](std::size_t y0, std::size_t count, const std::string& bytes) {
            if (bytes.size() != count * got.columns.count * sizeof(Complex))
                throw Error(ErrorCode::internal, "a message from another process has another size than it must have");
            for (std::size_t y = 0; y < count && got.columns.count > 0; ++y)
                std::memcpy(static_cast<void*>(place(next, columns, mine.first, y0 + y, got.columns.first)),
                            bytes.data() + y * got.columns.count * sizeof(Complex),
                            got.columns.count * sizeof(Complex));
        };
        const std::size_t sent_at_once = rows_at_once(sent), got_at_once = rows_at_once(got);
        std::size_t sending = sent.rows.first, getting = got.rows.first;
        while (sending < sent.rows.end() || getting < got.rows.end()) {
            if (sending < sent.rows.end()) {
                const std::size_t count = std::min(sent_at_once, sent.rows.end() - sending);
                team_->send_to(to, pack(sending, count));
                sending += count;
            }
            if (getting < got.rows.end()) {
                const std::size_t count = std::min(got_at_once, got.rows.end() - getting);
                unpack(getting, count, team_->receive_from(from));
                getting += count;
            }
        }
    }
    now_ = &next;
    first_ = mine.first;
}

PagedArray gather_rows(Team& team, const PagedArray& own, std::size_t rows, std::size_t rows_together,
                       const ScratchOptions& scratch) {
    const std::size_t columns = own.extent(1), bytes = columns * sizeof(Complex);
    const std::size_t at_once = std::max<std::size_t>(1, max_message / bytes);
    PagedArray all;
    if (team.is_first()) all = PagedArray({rows, columns}, scratch);
    for (std::size_t process = 0; process < team.size(); ++process) {
        const LineRange range = lines_of(process, team.size(), rows, rows_together);
        for (std::size_t y = range.first; y < range.end(); y += at_once) {
            const std::size_t count = std::min(at_once, range.end() - y);
            if (team.rank() == process && process != 0) {
                team.receive_from(0);  // asks for them
                team.send_to(0, {reinterpret_cast<const char*>(&own.view()(y - range.first, 0)), count * bytes});
            } else if (team.is_first() && process != 0) {
                team.send_to(process, "");
                std::memcpy(static_cast<void*>(&all.view()(y, 0)), team.receive_from(process).data(), count * bytes);
            } else if (team.is_first()) {
                std::copy_n(&own.view()(y - range.first, 0), count * columns, &all.view()(y, 0));
            }
        }
    }
    return all;
}

}  // namespace hogel::core
