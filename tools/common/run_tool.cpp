#include "common/run_tool.h"

#include <csignal>
#include <exception>
#include <new>

#include "common/log.h"
#include "common/output.h"
#include "core/error.h"

namespace bvhio {

int runTool(const ToolInfo& tool, int argc, char** argv, const std::function<ExitCode(CommandLine&)>& body) {
    startLog(tool.name);
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is then an error of write(), reported as any other
    removeTemporariesOnSignals();
    try {
        CommandLine line(tool, argc, argv);
        return int(body(line));
    } catch (const HelpShown&) {
        return int(ExitCode::done);
    } catch (const Error& error) {
        logError(error.what());
        return int(error.kind());
    } catch (const std::bad_alloc&) {
        logError("out of memory");
        return int(ErrorKind::resources);
    } catch (const std::exception& error) {
        // For example a thread that the system does not start. Caught so that temporary files are removed.
        logError(std::string("cannot go on: ") + error.what());
        return int(ErrorKind::resources);
    }
}

}  // namespace bvhio
