// Shows the fault of some work on a page, in the language of the window.
#pragma once

#include <exception>

#include "study/app/language/below.h"

namespace study::app {

/// Runs `work` and shows its fault on `page`, where the operator asked for it.
template <class Page, class Work>
void showingFaults(Page& page, Work work)
{
    try {
        work();
    } catch (const std::exception& fault) {
        page.showFault(inOwnLanguage(fault.what()));
    }
}

}  // namespace study::app
