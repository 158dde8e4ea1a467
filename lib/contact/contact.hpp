#pragma once
// Contact: one step of it, and where to read on.
#include "contact/connect.hpp"
#include "contact/data/meeting.hpp"
#include "contact/data/workspace.hpp"
#include "contact/multiplier/enforce.hpp"
#include "contact/penalty/advance.hpp"
#include "contact/report/account.hpp"
#include "contact/report/forces.hpp"
#include "contact/report/view.hpp"
#include "contact/tracking/thickness.hpp"
