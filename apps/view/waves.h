// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "hogel/pipeline.h"

namespace hogel::view {

/// Takes pictures of the viewer's holograms by wave optics, one viewpoint at a time. Computes the holograms at the
/// first picture, because that takes long and many pages show only pictures by rays. Caches the pupil bands of the last
/// viewpoint. Not thread-safe.
class Waves {
  public:
    /// Computes holograms of one or three wavelengths with `looks` looks each. photograph() passes on its exceptions
    /// and calls it again the next time.
    using Make = std::function<Fields()>;
    /// Receives the mean of the looks so far, and their number.
    using Shown = std::function<void(const Image&, std::size_t)>;

    /// @param memory  BandCamera::memory of each of the two photographers
    /// @param making  progress of their work that all viewpoints share, not of make(); newer queries do not cancel it
    Waves(Make make, std::size_t looks, std::size_t memory, Progress making);

    std::size_t looks() const { return looks_; }
    /// Reports the mean of 1, 2, … `looks` looks (0: all): the pictures of `hogel photo --looks`.
    /// @param preview  the faster pictures of `hogel photo --preview`
    /// Throws Error(usage) as hogel::photograph() does, and Error(cancelled); completed looks stay cached.
    void photograph(const Camera& camera, std::size_t looks, bool preview, const Shown& shown,
                    const Progress& progress);

  private:
    Make make_;
    std::size_t looks_, memory_;
    Progress making_;
    Fields fields_;
    // [1] is for previews. Each caches the pupil bands of its last viewpoint.
    std::optional<EyePhotographer> photographers_[2];
};

}  // namespace hogel::view
