// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "hogel/array.h"
#include "hogel/core/alone.h"
#include "hogel/core/shared_plane.h"

namespace hogel::optics {

/// The looks of a photograph that each process of a team draws and exposes by itself. Films go from process to process:
/// each exposes its looks on what those before it have exposed, so that the sum is that of one process, and the first
/// one gets them from the last. Where there are too few looks the processes share each drawing instead.
class SharedLooks {
  public:
    /// @param at_once    looks whose light fits into memory; a process's own ones must, because it draws them before
    /// the
    ///                   film of those before it comes
    /// @param can_be_so  whether films are exposed look by look
    SharedLooks(std::size_t looks, std::size_t at_once, bool can_be_so);

    bool is_shared() const { return team_ != nullptr; }
    /// The looks that this process draws; all of them where they are not shared.
    const core::LineRange& own() const { return own_; }
    /// Whether this process exposes films of what it has drawn.
    bool exposes() const { return is_shared() || is_first_process(); }

    /// Calls draw(), by this process alone where looks are shared.
    template <class Draw>
    auto drawn(const Draw& draw) const {
        std::optional<core::AloneScope> alone;
        if (is_shared()) alone.emplace();
        return draw();
    }
    /// To be called before and after a film is exposed, by all processes for the same films in the same order.
    void take(Array<float, 2>& film) const;
    void hand_on(const Array<float, 2>& film) const;
    /// To be called for all films in the same order once more: then the first process has what all have exposed.
    void finish(Array<float, 2>& film) const;

  private:
    void receive(std::size_t process, Array<float, 2>& film) const;

    Team* team_ = nullptr;
    core::LineRange own_;
};

}  // namespace hogel::optics
