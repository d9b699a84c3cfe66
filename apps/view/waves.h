// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "hogel/pipeline.h"

namespace hogel::view {

/// Photographs by waves of one eye after the other. The holograms are made when the first is asked for, because that
/// takes long and many look at rays alone. For one thread at a time.
class Waves {
  public:
    /// Makes holograms of one or three wavelengths, each of `looks` looks. What it throws is thrown by photograph(),
    /// each time.
    using Make = std::function<Fields()>;
    /// Receives the mean of so many looks.
    using Shown = std::function<void(const Image&, std::size_t)>;

    /// @param making  the progress of making them and of what all eyes share; newer views do not stop it
    Waves(Make make, std::size_t looks, std::size_t memory, Progress making);

    std::size_t looks() const { return looks_; }
    /// Shows the mean of the first look, of two, … of `looks` of them (0: all): the pictures of `hogel photo --looks`.
    /// @param preview  those of `hogel photo --preview`, which take less time
    /// Throws Error(usage) as hogel::photograph() does, and Error(cancelled); the looks that were drawn before are
    /// kept.
    void photograph(const Camera& camera, std::size_t looks, bool preview, const Shown& shown,
                    const Progress& progress);

  private:
    Make make_;
    std::size_t looks_, memory_;
    Progress making_;
    Fields fields_;
    // The second one is of previews: of either kind the light of the last eye is kept.
    std::optional<EyePhotographer> photographers_[2];
};

}  // namespace hogel::view
