#include "core/report.h"

namespace bvhio {

std::string jsonText(const Report& report, int indent) {
    return report.dump(indent, ' ', false, Report::error_handler_t::replace);
}

}  // namespace bvhio
