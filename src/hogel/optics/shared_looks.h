// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hogel/array.h"
#include "hogel/core/shared_plane.h"
#include "hogel/optics/eye_light.h"
#include "hogel/optics/film/film.h"

namespace hogel::optics {

/// The looks of a photograph that each process of a team draws and exposes by itself. Films go from process to process:
/// each adds its looks to those of the processes before it, so that the sum is that of one process, and the first one
/// gets them from the last. Where a drawing has rows, each process draws some of them for all looks, so that none
/// prepares all hogels. Where there are too few looks the processes share each drawing instead.
class SharedLooks {
  public:
    /// @param at_once    looks whose light fits into memory; a process's own ones must, because it draws them before
    ///                   the film of those before it comes
    /// @param can_be_so  whether films are exposed look by look
    SharedLooks(const EyeDrawing& drawing, std::size_t looks, std::size_t at_once, bool can_be_so);

    bool is_shared() const { return team_ != nullptr; }
    /// The looks that this process draws; all of them where they are not shared.
    const core::LineRange& own() const { return own_; }
    /// Whether this process exposes films of what it has drawn.
    bool exposes() const { return is_shared() || is_first_process(); }

    /// The bands of looks [first, first + count), which are all of the own ones where looks are shared.
    PackedBands drawn(std::size_t first, std::size_t count, const Progress& progress) const;
    /// Exposes a film, of which a camera's picture is developed, to looks that have been drawn. All processes call it
    /// for the same films in the same order.
    void expose(const film::Film& film, std::span<const film::PupilWave> looks, const Camera& camera,
                Array<float, 2>& intensity) const;
    /// To be called for all films in the same order once more: then the first process has what all have exposed.
    void finish(Array<float, 2>& film) const;

  private:
    void receive(std::size_t process, Array<float, 2>& film) const;

    const EyeDrawing& drawing_;
    Team* team_ = nullptr;
    std::size_t looks_;
    std::vector<core::LineRange> looks_of_;  // of each process
    core::LineRange own_;
};

}  // namespace hogel::optics
