#pragma once
// What contact has in the ledger.

#include "base/account.hpp"
#include "contact/data/memory.hpp"

namespace nereid::contact {

double stored(const Memory&);             ///< [J] by the penalty
double tangential_stored(const Memory&);  ///< [J] by the elastic stick of friction

/// The schema of an interface in the ledger, and its values now.
Source source(const Interface&);
Source source(const EdgeContact&);
void post(const Interface&, const Memory&, Account&);
void post(const EdgeContact&, const EdgeMemory&, Account&);

}  // namespace nereid::contact
