#pragma once
// What one update of an element reports, channel by channel as its kind lists them.

#include <array>

#include "base/account.hpp"
#include "base/number.hpp"

namespace nereid::element {

/// What one update of an element has to report; `Kind::stored_channels` and `Kind::dissipated_channels` say of what.
template <class T, class Kind>
struct Report {
  std::array<T, Kind::stored_channels.size()> stored;          ///< [J] increments
  std::array<T, Kind::dissipated_channels.size()> dissipated;  ///< [J] in this step
  T step;                                                      ///< [s] largest stable step of this element as it is now
  T volume_ratio;                                              ///< [-] volume (plates: area) over that of the reference; <= 0: inverted
  std::array<T, Kind::axes> along;                             ///< [-] of the step: strain of each axis, of plates growth of the area
  std::array<T, Kind::arms> arm = {};                          ///< [kg m] of fluids with weight: mass times the way from its nodes' centre

  /// One channel; zero if the kind does not have it. [J]
  T operator[](Stored channel) const { return of(channel, Kind::stored_channels, stored); }
  T operator[](Dissipated channel) const { return of(channel, Kind::dissipated_channels, dissipated); }

 private:
  template <class Channel, std::size_t count>
  static T of(Channel channel, const std::array<Channel, count>& channels, const std::array<T, count>& values) {
    for (std::size_t i = 0; i < count; ++i)
      if (channels[i] == channel) return values[i];
    return T(0.0);
  }
};

}  // namespace nereid::element
