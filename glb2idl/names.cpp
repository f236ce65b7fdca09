// SPDX-License-Identifier: Apache-2.0
// Tables of reserved names.

#include "glb2idl/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <unordered_set>

#include "core/schema/idl_word.h"
#include "glb2idl/text.h"
#include "glb2idl/type_words.h"

namespace indurop::glb2idl {
namespace {

using Words = std::unordered_set<std::string>;

Words split(const char* text) {
  std::istringstream in(text);
  Words words;
  for (std::string word; in >> word;) {
    words.insert(word);
  }
  return words;
}

// Keywords of C and C++.
const Words& keywords() {
  static const Words kWords = split(
      "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t char8_t class "
      "co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue "
      "decltype default delete do double dynamic_cast else enum explicit export extern false float for friend goto "
      "if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private "
      "protected public register reinterpret_cast requires restrict return short signed sizeof static static_assert "
      "static_cast struct switch template this thread_local throw true try typedef typeid typename typeof union "
      "unsigned using virtual void volatile wchar_t while xor xor_eq ");
  return kWords;
}

// Macros of the headers that modules include; the preprocessor would replace declarations of such a name.
// Long: it is a list.
const Words& macros() {
  static const Words kWords = split(
      "ADJ_ESTERROR ADJ_FREQUENCY ADJ_MAXERROR ADJ_MICRO ADJ_NANO ADJ_OFFSET ADJ_OFFSET_SINGLESHOT ADJ_OFFSET_SS_READ "
      "ADJ_SETOFFSET ADJ_STATUS ADJ_TAI ADJ_TICK ADJ_TIMECONST AIO_PRIO_DELTA_MAX ATOMIC_BOOL_LOCK_FREE "
      "ATOMIC_CHAR16_T_LOCK_FREE ATOMIC_CHAR32_T_LOCK_FREE ATOMIC_CHAR8_T_LOCK_FREE ATOMIC_CHAR_LOCK_FREE "
      "ATOMIC_FLAG_INIT ATOMIC_INT_LOCK_FREE ATOMIC_LLONG_LOCK_FREE ATOMIC_LONG_LOCK_FREE ATOMIC_POINTER_LOCK_FREE "
      "ATOMIC_SHORT_LOCK_FREE ATOMIC_VAR_INIT ATOMIC_WCHAR_T_LOCK_FREE BC_BASE_MAX BC_DIM_MAX BC_SCALE_MAX "
      "BC_STRING_MAX BIG_ENDIAN BOOL_MAX BOOL_WIDTH BUFSIZ BYTE_ORDER CHARCLASS_NAME_MAX CHAR_BIT CHAR_MAX CHAR_MIN "
      "CHAR_WIDTH CLOCKS_PER_SEC CLOCK_BOOTTIME CLOCK_BOOTTIME_ALARM CLOCK_MONOTONIC CLOCK_MONOTONIC_COARSE "
      "CLOCK_MONOTONIC_RAW CLOCK_PROCESS_CPUTIME_ID CLOCK_REALTIME CLOCK_REALTIME_ALARM CLOCK_REALTIME_COARSE "
      "CLOCK_TAI CLOCK_THREAD_CPUTIME_ID CLONE_CHILD_CLEARTID CLONE_CHILD_SETTID CLONE_DETACHED CLONE_FILES CLONE_FS "
      "CLONE_IO CLONE_NEWCGROUP CLONE_NEWIPC CLONE_NEWNET CLONE_NEWNS CLONE_NEWPID CLONE_NEWTIME CLONE_NEWUSER "
      "CLONE_NEWUTS CLONE_PARENT CLONE_PARENT_SETTID CLONE_PIDFD CLONE_PTRACE CLONE_SETTLS CLONE_SIGHAND "
      "CLONE_SYSVSEM CLONE_THREAD CLONE_UNTRACED CLONE_VFORK CLONE_VM CLOSE_RANGE_CLOEXEC CLOSE_RANGE_UNSHARE "
      "COLL_WEIGHTS_MAX CPU_SETSIZE CSIGNAL DBL_DECIMAL_DIG DBL_DIG DBL_EPSILON DBL_HAS_SUBNORM DBL_MANT_DIG DBL_MAX "
      "DBL_MAX_10_EXP DBL_MAX_EXP DBL_MIN DBL_MIN_10_EXP DBL_MIN_EXP DBL_TRUE_MIN DECIMAL_DIG DELAYTIMER_MAX E2BIG "
      "EACCES EADDRINUSE EADDRNOTAVAIL EADV EAFNOSUPPORT EAGAIN EALREADY EBADE EBADF EBADFD EBADMSG EBADR EBADRQC "
      "EBADSLT EBFONT EBUSY ECANCELED ECHILD ECHRNG ECOMM ECONNABORTED ECONNREFUSED ECONNRESET EDEADLK EDEADLOCK "
      "EDESTADDRREQ EDOM EDOTDOT EDQUOT EEXIST EFAULT EFBIG EHOSTDOWN EHOSTUNREACH EHWPOISON EIDRM EILSEQ EINPROGRESS "
      "EINTR EINVAL EIO EISCONN EISDIR EISNAM EKEYEXPIRED EKEYREJECTED EKEYREVOKED EL2HLT EL2NSYNC EL3HLT EL3RST "
      "ELIBACC ELIBBAD ELIBEXEC ELIBMAX ELIBSCN ELNRNG ELOOP EMEDIUMTYPE EMFILE EMLINK EMSGSIZE EMULTIHOP "
      "ENAMETOOLONG ENAVAIL ENETDOWN ENETRESET ENETUNREACH ENFILE ENOANO ENOBUFS ENOCSI ENODATA ENODEV ENOENT ENOEXEC "
      "ENOKEY ENOLCK ENOLINK ENOMEDIUM ENOMEM ENOMSG ENONET ENOPKG ENOPROTOOPT ENOSPC ENOSR ENOSTR ENOSYS ENOTBLK "
      "ENOTCONN ENOTDIR ENOTEMPTY ENOTNAM ENOTRECOVERABLE ENOTSOCK ENOTSUP ENOTTY ENOTUNIQ ENXIO EOF EOPNOTSUPP "
      "EOVERFLOW EOWNERDEAD EPERM EPFNOSUPPORT EPIPE EPROTO EPROTONOSUPPORT EPROTOTYPE ERANGE EREMCHG EREMOTE "
      "EREMOTEIO ERESTART ERFKILL EROFS ESHUTDOWN ESOCKTNOSUPPORT ESPIPE ESRCH ESRMNT ESTALE ESTRPIPE ETIME ETIMEDOUT "
      "ETOOMANYREFS ETXTBSY EUCLEAN EUNATCH EUSERS EWOULDBLOCK EXDEV EXFULL EXIT_FAILURE EXIT_SUCCESS EXPR_NEST_MAX "
      "FD_CLR FD_ISSET FD_SET FD_SETSIZE FD_ZERO FILENAME_MAX FLT_DECIMAL_DIG FLT_DIG FLT_EPSILON FLT_EVAL_METHOD "
      "FLT_HAS_SUBNORM FLT_MANT_DIG FLT_MAX FLT_MAX_10_EXP FLT_MAX_EXP FLT_MIN FLT_MIN_10_EXP FLT_MIN_EXP FLT_RADIX "
      "FLT_ROUNDS FLT_TRUE_MIN FOPEN_MAX FP_ILOGB0 FP_ILOGBNAN FP_INFINITE FP_INT_DOWNWARD FP_INT_TONEAREST "
      "FP_INT_TONEARESTFROMZERO FP_INT_TOWARDZERO FP_INT_UPWARD FP_LLOGB0 FP_LLOGBNAN FP_NAN FP_NORMAL FP_SUBNORMAL "
      "FP_ZERO F_LOCK F_OK F_TEST F_TLOCK F_ULOCK HOST_NAME_MAX HUGE_VAL HUGE_VALF HUGE_VALL INFINITY INT16_C "
      "INT16_MAX INT16_MIN INT16_WIDTH INT32_C INT32_MAX INT32_MIN INT32_WIDTH INT64_C INT64_MAX INT64_MIN "
      "INT64_WIDTH INT8_C INT8_MAX INT8_MIN INT8_WIDTH INTMAX_C INTMAX_MAX INTMAX_MIN INTMAX_WIDTH INTPTR_MAX "
      "INTPTR_MIN INTPTR_WIDTH INT_FAST16_MAX INT_FAST16_MIN INT_FAST16_WIDTH INT_FAST32_MAX INT_FAST32_MIN "
      "INT_FAST32_WIDTH INT_FAST64_MAX INT_FAST64_MIN INT_FAST64_WIDTH INT_FAST8_MAX INT_FAST8_MIN INT_FAST8_WIDTH "
      "INT_LEAST16_MAX INT_LEAST16_MIN INT_LEAST16_WIDTH INT_LEAST32_MAX INT_LEAST32_MIN INT_LEAST32_WIDTH "
      "INT_LEAST64_MAX INT_LEAST64_MIN INT_LEAST64_WIDTH INT_LEAST8_MAX INT_LEAST8_MIN INT_LEAST8_WIDTH INT_MAX "
      "INT_MIN INT_WIDTH IOV_MAX LC_ADDRESS LC_ADDRESS_MASK LC_ALL LC_ALL_MASK LC_COLLATE LC_COLLATE_MASK LC_CTYPE "
      "LC_CTYPE_MASK LC_GLOBAL_LOCALE LC_IDENTIFICATION LC_IDENTIFICATION_MASK LC_MEASUREMENT LC_MEASUREMENT_MASK "
      "LC_MESSAGES LC_MESSAGES_MASK LC_MONETARY LC_MONETARY_MASK LC_NAME LC_NAME_MASK LC_NUMERIC LC_NUMERIC_MASK "
      "LC_PAPER LC_PAPER_MASK LC_TELEPHONE LC_TELEPHONE_MASK LC_TIME LC_TIME_MASK LDBL_DECIMAL_DIG LDBL_DIG "
      "LDBL_EPSILON LDBL_HAS_SUBNORM LDBL_MANT_DIG LDBL_MAX LDBL_MAX_10_EXP LDBL_MAX_EXP LDBL_MIN LDBL_MIN_10_EXP "
      "LDBL_MIN_EXP LDBL_TRUE_MIN LINE_MAX LITTLE_ENDIAN LLONG_MAX LLONG_MIN LLONG_WIDTH LOGIN_NAME_MAX LONG_BIT "
      "LONG_LONG_MAX LONG_LONG_MIN LONG_MAX LONG_MIN LONG_WIDTH L_INCR L_SET L_XTND L_ctermid L_cuserid L_tmpnam "
      "MATH_ERREXCEPT MATH_ERRNO MAXFLOAT MAX_CANON MAX_INPUT MB_CUR_MAX MB_LEN_MAX MINSIGSTKSZ MOD_CLKA MOD_CLKB "
      "MOD_ESTERROR MOD_FREQUENCY MOD_MAXERROR MOD_MICRO MOD_NANO MOD_OFFSET MOD_STATUS MOD_TAI MOD_TIMECONST "
      "MQ_PRIO_MAX M_1_PI M_1_PIf M_2_PI M_2_PIf M_2_SQRTPI M_2_SQRTPIf M_E M_Ef M_LN10 M_LN10f M_LN2 M_LN2f M_LOG10E "
      "M_LOG10Ef M_LOG2E M_LOG2Ef M_PI M_PI_2 M_PI_2f M_PI_4 M_PI_4f M_PIf M_SQRT1_2 M_SQRT1_2f M_SQRT2 M_SQRT2f "
      "NAME_MAX NAN NFDBITS NGREG NGROUPS_MAX NL_ARGMAX NL_LANGMAX NL_MSGMAX NL_NMAX NL_SETMAX NL_TEXTMAX NSIG NULL "
      "NZERO PATH_MAX PDP_ENDIAN PIPE_BUF PTHREAD_ADAPTIVE_MUTEX_INITIALIZER_NP PTHREAD_ATTR_NO_SIGMASK_NP "
      "PTHREAD_BARRIER_SERIAL_THREAD PTHREAD_CANCELED PTHREAD_CANCEL_ASYNCHRONOUS PTHREAD_CANCEL_DEFERRED "
      "PTHREAD_CANCEL_DISABLE PTHREAD_CANCEL_ENABLE PTHREAD_COND_INITIALIZER PTHREAD_CREATE_DETACHED "
      "PTHREAD_CREATE_JOINABLE PTHREAD_DESTRUCTOR_ITERATIONS PTHREAD_ERRORCHECK_MUTEX_INITIALIZER_NP "
      "PTHREAD_EXPLICIT_SCHED PTHREAD_INHERIT_SCHED PTHREAD_KEYS_MAX PTHREAD_MUTEX_INITIALIZER PTHREAD_ONCE_INIT "
      "PTHREAD_RECURSIVE_MUTEX_INITIALIZER_NP PTHREAD_RWLOCK_INITIALIZER "
      "PTHREAD_RWLOCK_WRITER_NONRECURSIVE_INITIALIZER_NP PTHREAD_SCOPE_PROCESS PTHREAD_SCOPE_SYSTEM PTHREAD_STACK_MIN "
      "PTRDIFF_MAX PTRDIFF_MIN PTRDIFF_WIDTH P_tmpdir RAND_MAX RENAME_EXCHANGE RENAME_NOREPLACE RENAME_WHITEOUT "
      "RE_DUP_MAX RTSIG_MAX R_OK SA_INTERRUPT SA_NOCLDSTOP SA_NOCLDWAIT SA_NODEFER SA_NOMASK SA_ONESHOT SA_ONSTACK "
      "SA_RESETHAND SA_RESTART SA_SIGINFO SA_STACK SCHAR_MAX SCHAR_MIN SCHAR_WIDTH SCHED_BATCH SCHED_DEADLINE "
      "SCHED_FIFO SCHED_IDLE SCHED_ISO SCHED_OTHER SCHED_RESET_ON_FORK SCHED_RR SEEK_CUR SEEK_DATA SEEK_END SEEK_HOLE "
      "SEEK_SET SEM_VALUE_MAX SHRT_MAX SHRT_MIN SHRT_WIDTH SIGABRT SIGALRM SIGBUS SIGCHLD SIGCLD SIGCONT SIGEV_NONE "
      "SIGEV_SIGNAL SIGEV_THREAD SIGEV_THREAD_ID SIGFPE SIGHUP SIGILL SIGINT SIGIO SIGIOT SIGKILL SIGPIPE SIGPOLL "
      "SIGPROF SIGPWR SIGQUIT SIGRTMAX SIGRTMIN SIGSEGV SIGSTKFLT SIGSTKSZ SIGSTOP SIGSYS SIGTERM SIGTRAP SIGTSTP "
      "SIGTTIN SIGTTOU SIGURG SIGUSR1 SIGUSR2 SIGVTALRM SIGWINCH SIGXCPU SIGXFSZ SIG_ATOMIC_MAX SIG_ATOMIC_MIN "
      "SIG_ATOMIC_WIDTH SIG_BLOCK SIG_DFL SIG_ERR SIG_HOLD SIG_IGN SIG_SETMASK SIG_UNBLOCK SIZE_MAX SIZE_WIDTH SNAN "
      "SNANF SNANF128 SNANF32 SNANF32X SNANF64 SNANF64X SNANL SSIZE_MAX STA_CLK STA_CLOCKERR STA_DEL STA_FLL "
      "STA_FREQHOLD STA_INS STA_MODE STA_NANO STA_PLL STA_PPSERROR STA_PPSFREQ STA_PPSJITTER STA_PPSSIGNAL "
      "STA_PPSTIME STA_PPSWANDER STA_RONLY STA_UNSYNC STDERR_FILENO STDIN_FILENO STDOUT_FILENO TEMP_FAILURE_RETRY "
      "TIMER_ABSTIME TIME_UTC TMP_MAX TTY_NAME_MAX UCHAR_MAX UCHAR_WIDTH UINT16_C UINT16_MAX UINT16_WIDTH UINT32_C "
      "UINT32_MAX UINT32_WIDTH UINT64_C UINT64_MAX UINT64_WIDTH UINT8_C UINT8_MAX UINT8_WIDTH UINTMAX_C UINTMAX_MAX "
      "UINTMAX_WIDTH UINTPTR_MAX UINTPTR_WIDTH UINT_FAST16_MAX UINT_FAST16_WIDTH UINT_FAST32_MAX UINT_FAST32_WIDTH "
      "UINT_FAST64_MAX UINT_FAST64_WIDTH UINT_FAST8_MAX UINT_FAST8_WIDTH UINT_LEAST16_MAX UINT_LEAST16_WIDTH "
      "UINT_LEAST32_MAX UINT_LEAST32_WIDTH UINT_LEAST64_MAX UINT_LEAST64_WIDTH UINT_LEAST8_MAX UINT_LEAST8_WIDTH "
      "UINT_MAX UINT_WIDTH ULLONG_MAX ULLONG_WIDTH ULONG_LONG_MAX ULONG_MAX ULONG_WIDTH USHRT_MAX USHRT_WIDTH "
      "WCHAR_MAX WCHAR_MIN WCHAR_WIDTH WCONTINUED WEOF WEXITED WEXITSTATUS WIFCONTINUED WIFEXITED WIFSIGNALED "
      "WIFSTOPPED WINT_MAX WINT_MIN WINT_WIDTH WNOHANG WNOWAIT WORD_BIT WSTOPPED WSTOPSIG WTERMSIG WUNTRACED W_OK "
      "XATTR_LIST_MAX XATTR_NAME_MAX XATTR_SIZE_MAX X_OK alloca be16toh be32toh be64toh errno htobe16 htobe32 htobe64 "
      "htole16 htole32 htole64 issubnormal le16toh le32toh le64toh linux math_errhandling offsetof "
      "pthread_cleanup_pop pthread_cleanup_pop_restore_np pthread_cleanup_push pthread_cleanup_push_defer_np "
      "sa_handler sa_sigaction sched_priority sigev_notify_attributes sigev_notify_function sigmask stderr stdin "
      "stdout strdupa strndupa unix ");
  return kWords;
}

// Types of the C library: the same name in a namespace becomes ambiguous after `using namespace`.
const Words& system_types() {
  static const Words kWords = split(
      "DIR FILE blkcnt_t blksize_t byte caddr_t char8_t clock_t clockid_t daddr_t dev_t div_t double_t errno_t "
      "error_t fd_set float_t fpos_t gid_t id_t ino_t intmax_t intptr_t jmp_buf key_t ldiv_t locale_t loff_t "
      "max_align_t mode_t nlink_t nullptr_t off_t pid_t ptrdiff_t quad_t register_t sem_t siginfo_t sigset_t size_t "
      "ssize_t stack_t suseconds_t time_t timer_t u_char u_int u_long u_short uid_t uint uintmax_t uintptr_t ulong "
      "useconds_t ushort va_list wint_t ");
  return kWords;
}

// Names that already exist outside all namespaces: the C library, InduRoP's namespaces, the functions of a module.
const Words& global_names() {
  static const Words kWords = split(
      "abort abs accept access acct acos acosh alarm alloca asctime asin asinh atan atan2 atanh atexit atof atoi "
      "atol basename bind brk bsearch calloc cbrt ceil channel chdir chmod chown chroot clearerr clock clone close "
      "condition confstr connect copysign cos cosh creat crypt ctime daemon daylight dds difftime div dprintf "
      "drand48 dup dup2 encrypt environ erf erfc err errx execl execv execve exit exp exp2 expm1 fabs fchmod fclose "
      "fcntl fdatasync fdim feof ferror fflush ffs fgetc fgets fileno flock floor fma fmax fmin fmod fopen fork "
      "fprintf fputc fputs fread free freopen frexp fscanf fseek fstat fsync ftell ftruncate fwrite gamma getc "
      "getchar getdate getenv gethostid getline getlogin getopt getpass getpid gets getsubopt gettid gettimeofday "
      "getwd gmtime hypot ilogb index indurop ioctl irp isalnum isalpha isatty iscntrl isdigit isfinite isgraph "
      "isinf islower isnan isnormal isprint ispunct isspace isupper isxdigit j0 j1 jn kill labs lchown ldexp ldiv "
      "lgamma link listen llabs lldiv llrint llround localtime lockf log log10 log1p log2 logb longjmp lrand48 "
      "lrint lround lseek lstat main malloc memchr memcmp memcpy memmove memset mkdir mknod mktime mlock mmap modf "
      "mount mprotect mrand48 mremap munlock munmap nan nanosleep nearbyint nextafter nftw nice open pause perror "
      "pipe pipe2 poll popen posix_memalign pow pread printf profil psignal ptrace putc putchar putenv puts pwrite "
      "qsort raise rand random read readlink realloc reboot recv remainder remove rename rewind rindex rint rmdir "
      "round rpmatch run sbrk scalb scalbn scanf select send setbuf setenv sethostname setjmp setpgid setsid "
      "settimeofday setuid shutdown sigaction siginterrupt signal signbit signgam sigpause sigqueue sigwait sin "
      "sincos sinh sleep snprintf socket splice sprintf sqrt srand sscanf start stat std stime stop strcat strchr "
      "strcmp strcpy strdup strlen strncmp strsep strsignal strstr strtod strtok strtol strtoul swab swapoff swapon "
      "symlink sync syscall sysconf syslog system tan tanh tcgetpgrp tee tempnam tgamma time timegm times timezone "
      "tmpfile tmpnam toascii tolower toupper trunc truncate ttyname tzname tzset ualarm umask uname ungetc unlink "
      "unshare usleep utime vfork vhangup vprintf wait waitid waitpid warn warnx write y0 y1 yn ");
  return kWords;
}

// Members that every generated struct shape has.
constexpr std::array<std::string_view, 5> kShapeMembers{"value_type", "whole_type", "tag_type", "kOffset", "get"};
// Namespaces and functions that modules use without a prefix.
constexpr std::array<std::string_view, 4> kPlatformNamespaces{"std", "indurop", "irp", "channel"};
constexpr std::array<std::string_view, 4> kPlatformFunctions{"lock", "property", "read", "write"};
constexpr std::size_t kLongest = 100;

template <std::size_t N>
bool has(const std::array<std::string_view, N>& list, std::string_view name) noexcept {
  return std::find(list.begin(), list.end(), name) != list.end();
}

std::optional<std::string> form_objection(std::string_view name, NameRole role) {
  if (name.size() > kLongest) {
    return fmt::format("is longer than {} characters", kLongest);
  }
  if (name.starts_with('_')) {
    return "begins with '_', which IDL and C++ keep for themselves";
  }
  if (name.find("__") != std::string_view::npos) {
    return "contains '__', which C++ and the names of DDS types keep for themselves";
  }
  if (name.ends_with('_') && role != NameRole::Field && role != NameRole::Parameter) {
    return "ends with '_', which is used for the DDS types of variables";
  }
  if (lower(name).starts_with("indurop")) {
    return "begins with 'indurop', which is used by generated code";
  }
  return std::nullopt;
}

}  // namespace

bool is_system_macro(std::string_view name) {
  return macros().contains(std::string(name));
}

std::optional<std::string> objection(std::string_view name, NameRole role, bool global) {
  if (auto form = form_objection(name, role)) {
    return form;
  }
  const std::string word(name);
  const bool inner = role == NameRole::Field || role == NameRole::Parameter;
  if (keywords().contains(word)) {
    return "is a keyword";
  }
  if (fixed_type(name)) {
    return "is a type";
  }
  if (macros().contains(word)) {
    return "is a macro of the system headers";
  }
  if (word.starts_with("INDUROP_")) {
    return "is one of the platform's macros";
  }
  if ((role == NameRole::Type || role == NameRole::Namespace) && schema::is_idl_keyword(name)) {
    return "is a keyword of IDL";
  }
  if (inner) {
    return has(kShapeMembers, name) ? std::optional<std::string>("is used by generated code") : std::nullopt;
  }
  if (has(kPlatformNamespaces, name)) {
    return "is a namespace of the platform or of C++";
  }
  if (role != NameRole::Namespace && has(kPlatformFunctions, name)) {
    return "would hide the platform's function of this name";
  }
  if (role == NameRole::Type && system_types().contains(word)) {
    return "is a type of the C library";
  }
  if (global && (global_names().contains(word) || system_types().contains(word))) {
    return "is taken outside of namespaces, by the C library or the platform";
  }
  return std::nullopt;
}

std::string proposal(std::string_view name, NameRole role, bool global) {
  constexpr std::size_t kRoom = 10;
  std::string word(name.substr(0, kLongest - kRoom));
  for (std::size_t at = word.find("__"); at != std::string::npos; at = word.find("__")) {
    word.erase(at, 1);
  }
  while (word.starts_with('_')) {
    word.erase(0, 1);
  }
  while (word.ends_with('_')) {
    word.pop_back();
  }
  if (word.empty() || lower(word).starts_with("indurop") || (word[0] >= '0' && word[0] <= '9')) {
    word = word.empty() ? "my" : "my_" + word;
  }
  if (!objection(word, role, global)) {
    return word;
  }
  switch (role) {
    case NameRole::Namespace:
      return word + "_space";
    case NameRole::Type:
      return word + "_type";
    case NameRole::Function:
      return word + "_now";
    case NameRole::Enumerator:
      return word + "_state";
    default:
      return word + "_value";
  }
}

}  // namespace indurop::glb2idl
