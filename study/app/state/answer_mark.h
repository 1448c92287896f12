// What a page tells the session about an answer that is not stored yet.
#pragma once

namespace study::app {

/// What happens to an answer before it is stored. The session stamps it.
enum class AnswerMark {
    Begun,    ///< the first key of its entry
    Spoken,   ///< the key or pedal that marks the spoken word
    Emptied,  ///< the entry is empty again
};

}  // namespace study::app
