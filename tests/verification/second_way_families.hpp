// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a family of second_way.hpp draws from; number and family of the study are filled in afterwards.
#pragma once

#include "verification/second_way.hpp"

namespace rubato::verification {

WayStudy edged_block(Dice& dice);
WayStudy nosed_block(Dice& dice);
WayStudy hook(Dice& dice);
WayStudy ring(Dice& dice);
WayStudy roller(Dice& dice);
WayStudy wedge(Dice& dice);
WayStudy lining(Dice& dice);
WayStudy seal(Dice& dice);
WayStudy bolted_plates(Dice& dice);
WayStudy stack(Dice& dice);
WayStudy punch(Dice& dice);
WayStudy impact(Dice& dice);

} // namespace rubato::verification
