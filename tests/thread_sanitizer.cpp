// Options of the thread sanitizer, for every test program. Only that build has this file.

// libstdc++ itself is built without the sanitizer, which so does not see how an exception_ptr counts who holds it: an error that
// a client's thread threw and another thread caught looks as if it were freed while it is read. Whoever reads it holds it.
extern "C" char const* __tsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): the sanitizer's own name
extern "C" char const* __tsan_default_suppressions() { return "race:std::__exception_ptr::exception_ptr::_M_release\n"; }
