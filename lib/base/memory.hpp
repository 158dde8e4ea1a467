#pragma once

namespace nereid {

/// The most memory of this process that has been resident at once so far. [bytes]
double most_resident();

/// What this process may still take: the least of what the machine has free, its group of processes may have and its own limit
/// leaves. [bytes]
double memory_left();

}  // namespace nereid
