#pragma once

namespace nereid {

/// The most memory of this process that has been resident at once so far. [bytes]
double most_resident();

}  // namespace nereid
