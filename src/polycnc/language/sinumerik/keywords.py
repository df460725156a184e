"""The vocabulary of the NC language (job planning 16.1), G functions excepted: those are the control's table.

Every word is in one of these tables; a word that is known but in none of the executed ones raises an alarm
that says so. Arguments are written as letters: I INT, R REAL, B BOOL, C CHAR, S STRING, A AXIS, F FRAME, `?`
any value, `*` any number of any values, `V` a variable to write to (array, element or single), `[` a whole
array, `W` a row of an array (`TABLE[1]`); a small letter may be left out.
"""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.language.sinumerik.names.values import Type

TYPE_LETTERS = {
    "I": Type.INT,
    "R": Type.REAL,
    "B": Type.BOOL,
    "C": Type.CHAR,
    "S": Type.STRING,
    "A": Type.AXIS,
    "F": Type.FRAME,
}


class Function(NamedTuple):
    """A predefined function: types of its arguments and value; the language's own ones have code."""

    arguments: str
    result: Type
    code: str = ""


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


def _functions(table: str) -> dict[str, Function]:
    functions = {}
    for line in table.strip().splitlines():
        name, arguments, result, *code = line.split(maxsplit=3)
        functions[name] = Function(arguments.strip("()"), Type[result], code[0] if code else "")
    return functions


#: Functions whose value depends on their arguments alone. `{0}` stands for the code of the first argument.
FUNCTIONS = _functions("""
SIN       (R)    REAL   sind({0})
COS       (R)    REAL   cosd({0})
TAN       (R)    REAL   tand({0})
ASIN      (R)    REAL   asind({0})
ACOS      (R)    REAL   acosd({0})
ATAN2     (RR)   REAL   atan2d({0}, {1})
SQRT      (R)    REAL   root({0})
POT       (R)    REAL   square({0})
LN        (R)    REAL   natural_log({0})
EXP       (R)    REAL   power_of_e({0})
TRUNC     (R)    REAL   float(trunc({0}))
ROUND     (R)    REAL   float(floor({0} + 0.5))
ROUNDUP   (R)    REAL   float(ceil({0}))
BOUND     (RRR)  REAL   bound({0}, {1}, {2})
AXSTRING  (A)    STRING {0}.name
AXNAME    (S)    AXIS   axis_named({1}, {0})
NUMBER    (S)    REAL   number_in({0})
ISNUMBER  (S)    BOOL   is_number({0})
TOUPPER   (S)    STRING {0}.upper()
TOLOWER   (S)    STRING {0}.lower()
STRLEN    (S)    INT    len({0})
INDEX     (SC)   INT    {0}.find(chr({1}))
RINDEX    (SC)   INT    {0}.rfind(chr({1}))
MINDEX    (SS)   INT    first_of({0}, {1})
MATCH     (SS)   INT    {0}.find({1})
SUBSTR    (SIi)  STRING part_of({0}, {1}, {2})
INVFRAME  (F)    FRAME  inverse_frame({0})
""")

#: Functions whose result has the type of their arguments.
SAME_TYPE_FUNCTIONS = {"ABS": (1, "abs({0})"), "MINVAL": (2, "min({0}, {1})"), "MAXVAL": (2, "max({0}, {1})")}

#: Frame functions with pairs of axis and value; CMIRROR has axes only.
FRAME_FUNCTIONS = {
    "CTRANS": "ctrans",
    "CFINE": "cfine",
    "CROT": "crot",
    "CSCALE": "cscale",
    "CMIRROR": "cmirror",
}

#: Functions that the control answers.
CONTROL_FUNCTIONS = _functions("""
ADDFRAME    (FS)        INT
AXTOSPI     (A)         INT
CALCDAT     ([I[)       BOOL
CALCPOSI    ([[[[bi)    INT
CHKDNO      (jjj)       BOOL
CHKDM       (ii)        INT
CROTS       (*)         FRAME
CRPL        (IR)        FRAME
CTAB        (RIVaa)     REAL
CTABEXISTS  (I)         BOOL
CTABFNO     (s)         INT
CTABFPOL    (s)         INT
CTABFSEG    (ss)        INT
CTABID      (Is)        INT
CTABINV     (RRIVaa)    REAL
CTABISLOCK  (I)         INT
CTABMEMTYP  (I)         INT
CTABMPOL    (s)         INT
CTABMSEG    (ss)        INT
CTABNO      ()          INT
CTABNOMEM   (s)         INT
CTABPERIOD  (I)         INT
CTABPOL     (s)         INT
CTABPOLID   (I)         INT
CTABSEG     (ss)        INT
CTABSEGID   (Is)        INT
CTABSEV     (RIVa)      REAL
CTABSSV     (RIVa)      REAL
CTABTEP     (Iva)       REAL
CTABTEV     (Iva)       REAL
CTABTMAX    (I????)     REAL
CTABTMIN    (I????)     REAL
CTABTSP     (Iva)       REAL
CTABTSV     (Iva)       REAL
DELDL       (ii)        INT
GETACTTD    (VI)        INT
GETDNO      (II)        INT
GETFREELOC  (VVIII)     INT
GETMDACT    ()          INT
GETT        (Si)        INT
GETTCOR     ([ssiii)    INT
GETTENV     (S[)        INT
DELTOOLENV  (s)         INT
INTERSEC    (WW[i)      BOOL
ISAXIS      (I)         BOOL
LENTOAX     ([[s)       INT
MEAFRAME    ([[V)       FRAME
MEASURE     ()          INT
MODAXVAL    (AR)        REAL
NEWT        (Si)        INT
POSRANGE    (ARRi)      BOOL
SETDNO      (III)       BOOL
SETTCOR     ([Sii?siii) INT
SPI         (I)         AXIS
SPRINT      (*)         STRING
TOOLENV     (S)         INT
""")

#: Functions on files and user arrays, with a leading VAR error argument where they are procedures.
FILE_PROCEDURES = {
    "WRITE": "VSS",
    "DELETE": "VS",
    "READ": "VSIIV",
    "FILEDATE": "VSV",
    "FILETIME": "VSV",
    "FILESIZE": "VSV",
    "FILESTAT": "VSV",
    "FILEINFO": "VSV",
}
#: Functions about names.
NAME_FUNCTIONS = {"STRINGIS": Function("S", Type.INT), "ISVAR": Function("S", Type.BOOL)}
FILE_FUNCTIONS = {"ISFILE": Function("S", Type.BOOL), "CHECKSUM": Function("VSii", Type.INT)}

#: Predefined procedures that the control executes.
_ANY_ARGUMENTS = """
    AXCTSWAP AXCTSWE AXCTSWED AXTOCHAN BRISKA CANCEL CHANDATA CLEARM CLRINT COARSEA COMPLETE CORROF
    COUPDEF COUPDEL COUPOF COUPOFS COUPON COUPONC COUPRES CPROT CPROTDEF CTABDEF CTABDEL CTABEND CTABLOCK
    CTABUNLOCK DELAYFSTOF DELAYFSTON DELDL DELDTG DIAMCHAN DISABLE DRFOF DRIVEA DZERO EGDEF EGDEL
    EGOFC EGOFS EGON EGONSYN EGONSYNE ENABLE FCTDEF FGROUP FINEA FOCOF FOCON FPR FPRAOF FPRAON FTOC GEOAX
    GET GETD GWPSOF GWPSON ICYCOF ICYCON INIT INITIAL IPOBRKA IPOENDA IPTRLOCK IPTRUNLOCK JERKA LEADOF LEADON LOCK
    MASLDEF MASLDEL MASLOF MASLOFS MASLON MMC MSG MVTOOL NEWCONF NPROT NPROTDEF ORIRESET POLFA POLFMASK POLFMLIN
    POLYPATH POSM PRESETON PUNCHACC PUTFTOC PUTFTOCF QECLRNOF QECLRNON RDISABLE RELEASE RESETMON SCC
    SEFORM SETAL SETM SETMS SETMTH SETPIECE SETTA SETTIA SIRELAY SIRELIN SIRELOUT SIRELTIME SOFTA SPCOF
    SPCON SPLINEPATH START STOPRE STOPREOF SYNFCT TANG TANGDEL TANGOF TANGON TCA TCI TLIFT TMOF TMON
    TOFFOF TOFFON TRAANG TRACON TRACYL TRAFOOF TRAILOF TRAILON TRANSMIT TRAORI UNLOCK WAITC WAITE WAITM
    WAITMC WAITP WAITS WRTPR RESET PROTA PROTD PROTS WORKPIECE GROUP_BEGIN GROUP_END
    GROUP_ADDEND
"""
PROCEDURES: dict[str, str] = {
    **dict.fromkeys(_ANY_ARGUMENTS.split(), "*"),
    "CONTPRON": "[?V?",
    "CONTDCON": "[?",
    "EXECUTE": "V",
    "EXECTAB": "W",
    "GETSELT": "Vi",
    "GETEXET": "Vi",
    "GETACTT": "VS",
    "MVTOOL": "VIIII",
    "RESETMON": "VIii",
    "DELT": "Si",
    "SETTA": "VIIi",
    "SETTIA": "VII",
    "SETDNO": "III",
}

#: Newer spellings of G functions.
SPELLINGS = {"RMIBL": "RMI", "RMBBL": "RMB", "RMEBL": "RME", "RMNBL": "RMN"}

#: Names whose arguments may stand in square brackets: `DELDL[1,2]` (7.2.3).
SQUARE = frozenset({"DELDL"})

#: Procedures whose axis may stand in brackets: `FINEA[X]`.
BRACKETED = frozenset({"FINEA", "COARSEA", "IPOENDA", "FOCON", "FOCOF", "SCC"})

#: Machining cycles of the control; a program of the same name in a cycle directory comes first.
CYCLES = _words(
    """
    CYCLE60 CYCLE61 CYCLE62 CYCLE63 CYCLE64 CYCLE70 CYCLE71 CYCLE72 CYCLE76 CYCLE77 CYCLE78 CYCLE79
    CYCLE81 CYCLE82 CYCLE83 CYCLE84 CYCLE85 CYCLE86 CYCLE87 CYCLE88 CYCLE89 CYCLE90 CYCLE92 CYCLE93
    CYCLE94 CYCLE95 CYCLE96 CYCLE97 CYCLE98 CYCLE99 CYCLE800 CYCLE801 CYCLE802 CYCLE830 CYCLE832
    CYCLE840 CYCLE899 CYCLE930 CYCLE940 CYCLE950 CYCLE951 CYCLE952 CYCLE971 CYCLE973 CYCLE974 CYCLE976
    CYCLE961 CYCLE972 CYCLE995 CYCLE116 CYCLE150 CYCLE435 CYCLE495
    CYCLE977 CYCLE978 CYCLE979 CYCLE982 CYCLE994 CYCLE996 CYCLE997 CYCLE998 HOLES1 HOLES2 LONGHOLE
    POCKET1 POCKET2 POCKET3 POCKET4 SLOT1 SLOT2
    """
)

#: Addresses of NC words beside the axes. Any of them may have an index in brackets; the control checks that.
ADDRESSES = _words(
    """
    A2 A3 A4 A5 A6 A7 A8 B2 B3 B4 B5 B6 B7 B8 C2 C3 C4 C5 C6 C7 C8 ACC ACCLIMA ADIS ADISPOS ADISPOSA ALF ANG AP AR
    ATOL AX CHF CHR CR CTOL CUTMOD D DILF DISC DISCL DISPR DISR DITE DITS DL F FA FAD FB FD FDA FGREF FL FMA FP
    FRC FRCM FXS FXST FXSW FZ H I I1 IP ISD J J1 JERKLIM JERKLIMA K K1 LEAD LIMS M MEAC MEAS MEASA MEAW
    MEAWA MOV NUT OFFN OMA1 OMA2 OMA3 OMA4 OMA5 ORIS OS OSB OSCILL OSCTRL OSE OSNSC OSP1 OSP2 OST1 OST2
    OTOL OVR OVRA OVRRAP P PHI PL PO POLF POS POSA POSP PSI PW RND RNDM RP RPL S SCPARA SD SF SPN
    SPOS SPOSA SPP SR SRA ST STA STAT SVC T TCARR THETA THT TILT TOFF TOFFL TOFFR TU TURN VELOLIM
    VELOLIMA XH YH ZH
    """
)

#: Words with an index and no value: `DIAMONA[X]`.
INDEXED_WORDS = frozenset({"DIAMONA", "DIAMOFA", "DIAM90A", "DIACYCOFA", "DIAMCHANA"})

#: Addresses whose value in parentheses is a list: `MEASA[X]=(1,1,-1)`.
LIST_ADDRESSES = frozenset(
    {
        "ADISPOSA",
        "MEASA",
        "MEAWA",
        "MEAC",
        "OSCTRL",
        "OSCILL",
        "POSP",
        "PO",
        "XH",
        "YH",
        "ZH",
        "PHI",
        "PSI",
        "THT",
    }
)

#: What may stand round the value of a word. Positioning attributes with their number for GP (1.2.2).
_ATTRIBUTES = "AC IC DC ACP ACN OC PC DAC DIC RAC RIC CAC CIC CDC CACP CACN"
POSITION_ATTRIBUTES = ("", *_ATTRIBUTES.split())
CODED_POSITIONS = frozenset({"CAC", "CIC", "CDC", "CACP", "CACN"})
MODIFIERS = frozenset({*POSITION_ATTRIBUTES[1:], "PM", "PR", "QU", "FPO", "PO", "GP"})
FRAME_COMPONENTS = frozenset({"TR", "FI", "RT", "SC", "MI"})

STRUCTURE = _words(
    """
    IF ELSE ENDIF LOOP ENDLOOP FOR ENDFOR WHILE ENDWHILE REPEAT UNTIL REPEATB CASE GOTO GOTOF GOTOB
    GOTOC GOTOS
    """
)
DEFINITIONS = frozenset({"DEF", "REDEF", "DEFINE", "PROC", "EXTERN"})
CALLS = frozenset({"CALL", "PCALL", "MCALL", "EXTCALL", "ISOCALL", "CALLPATH", "RET", "EXECSTRING"})
OPERATORS = frozenset({"AND", "OR", "NOT", "XOR", "B_AND", "B_OR", "B_NOT", "B_XOR", "DIV", "MOD"})

#: Words that only have a meaning behind others.
PARTS = _words(
    """
    ACTBLOCNO DISPLOF DISPLON APR APRB APRP APW APWB APWP APX AS AXIS BLOCK BLSYNC BOOL CHAN CHAR
    DEFAULT EX FALSE FRAME GP INICF INIPO INIRE INT LIFTFAST LLI NCK NO_AXIS OF PHU PREPRO PRIO PRLOC REAL REP
    SAVE SET STRING SYNR SYNRW SYNW TO TRUE ULI VAR
    """
)

#: Words that begin a synchronised action, and what polycnc knows but does not execute yet.
SYNCHRONOUS = frozenset({"ID", "IDS", "DO", "WHEN", "WHENEVER", "FROM", "EVERY"})
NOT_EXECUTED = frozenset({"STRINGFELD", "STRINGVAR", "ENDPROC", "RETTOOL"})

#: Single block off and on for the running level: the language keeps it.
SINGLE_BLOCK = frozenset({"SBLOF", "SBLON"})
#: Words that stand alone in their block (1.13, 1.25.2.5, 8.3, 8.4).
OWN_BLOCK = SINGLE_BLOCK | {
    "STOPRE",
    "DELAYFSTON",
    "DELAYFSTOF",
    "COMPLETE",
    "INITIAL",
    "INIT",
    "START",
    "WAITM",
    "WAITMC",
    "WAITE",
    "SETAL",
    "SETM",
    "CLEARM",
}

#: Names of the language itself: no macro redefines them (1.26). Cycles are programs that others may replace, and
#: components of frames stand in brackets alone.
RESERVED = frozenset().union(
    FUNCTIONS,
    SAME_TYPE_FUNCTIONS,
    FRAME_FUNCTIONS,
    CONTROL_FUNCTIONS,
    FILE_PROCEDURES,
    NAME_FUNCTIONS,
    FILE_FUNCTIONS,
    PROCEDURES,
    SPELLINGS,
    ADDRESSES,
    INDEXED_WORDS,
    LIST_ADDRESSES,
    MODIFIERS,
    STRUCTURE,
    DEFINITIONS,
    CALLS,
    OPERATORS,
    PARTS,
    SYNCHRONOUS,
    SINGLE_BLOCK,
)
