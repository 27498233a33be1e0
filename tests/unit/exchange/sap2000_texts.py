"""SAP2000's text of a small frame and a small building, as a person would write them."""

from __future__ import annotations

FRAME = """\
File portal.s2k was saved on m/d/yy at h:mm:ss

TABLE:  "PROGRAM CONTROL"
   ProgramName=SAP2000   Version=20.2.0   CurrUnits="KN, m, C"   SteelCode="AISC 360-10"

TABLE:  "PREFERENCES - DIMENSIONAL"
   MergeTol=0.001

TABLE:  "MATERIAL PROPERTIES 01 - GENERAL"
   Material=S275   Type=Steel   SymType=Isotropic   TempDepend=No

TABLE:  "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES"
   Material=S275   UnitWeight=77   UnitMass=7.85   E1=210000000   G12=80769230.7692308   U12=0.3

TABLE:  "MATERIAL PROPERTIES 03A - STEEL DATA"
   Material=S275   Fy=275000   Fu=430000

TABLE:  "FRAME SECTION PROPERTIES 01 - GENERAL"
   SectionName=HEB300   Material=S275   Shape="I/Wide Flange"   t3=0.3   t2=0.3   tf=0.019   tw=0.011 _
        t2b=0.3   tfb=0.019   Area=0.01491   TorsConst=1.85E-06   I33=0.0002517   I22=8.563E-05   AS2=0.0033
   SectionName="IPE 400"   Material=S275   Shape=General   Area=0.008446   TorsConst=5.1E-07   I33=0.0002313 _
        I22=1.318E-05

TABLE:  "JOINT COORDINATES"
   Joint=1   CoordSys=GLOBAL   CoordType=Cartesian   XorR=0   Y=0   Z=0   SpecialJt=No
   Joint=2   CoordSys=GLOBAL   CoordType=Cartesian   XorR=6   Y=0   Z=0   SpecialJt=No
   Joint=3   CoordSys=GLOBAL   CoordType=Cartesian   XorR=0   Y=0   Z=4   SpecialJt=No
   Joint=4   CoordSys=GLOBAL   CoordType=Cartesian   XorR=6   Y=0   Z=4   SpecialJt=No

TABLE:  "JOINT RESTRAINT ASSIGNMENTS"
   Joint=1   U1=Yes   U2=Yes   U3=Yes   R1=Yes   R2=Yes   R3=Yes
   Joint=2   U1=Yes   U2=Yes   U3=Yes   R1=No   R2=No   R3=No

TABLE:  "CONNECTIVITY - FRAME"
   Frame=c1   JointI=1   JointJ=3   IsCurved=No
   Frame=c2   JointI=4   JointJ=2   IsCurved=No
   Frame=b1   JointI=3   JointJ=4   IsCurved=No

TABLE:  "FRAME SECTION ASSIGNMENTS"
   Frame=c1   AutoSelect=N.A.   AnalSect=HEB300   MatProp=Default
   Frame=c2   AutoSelect=N.A.   AnalSect=HEB300   MatProp=Default
   Frame=b1   AutoSelect=N.A.   AnalSect="IPE 400"   MatProp=Default

TABLE:  "LOAD PATTERN DEFINITIONS"
   LoadPat=DEAD   DesignType=Dead   SelfWtMult=1
   LoadPat=LIVE   DesignType=Live   SelfWtMult=0
   LoadPat=WIND   DesignType=Wind   SelfWtMult=0

TABLE:  "FRAME LOADS - DISTRIBUTED"
   Frame=b1   LoadPat=DEAD   CoordSys=GLOBAL   Type=Force   Dir=Gravity   DistType=RelDist   RelDistA=0   RelDistB=1 _
        AbsDistA=0   AbsDistB=6   FOverLA=20   FOverLB=20
   Frame=b1   LoadPat=LIVE   CoordSys=GLOBAL   Type=Force   Dir=Z   DistType=RelDist   RelDistA=0.25   RelDistB=0.75 _
        FOverLA=-4   FOverLB=-6

TABLE:  "JOINT LOADS - FORCE"
   Joint=3   LoadPat=DEAD   CoordSys=GLOBAL   F1=0   F2=0   F3=-50   M1=0   M2=0   M3=0
   Joint=3   LoadPat=WIND   CoordSys=GLOBAL   F1=10   F2=0   F3=0   M1=0   M2=0   M3=0

TABLE:  "MASS SOURCE"
   MassSource=MSSSRC1   Elements=No   Masses=No   Loads=Yes   IsDefault=Yes   LoadPat=DEAD   Multiplier=1
   MassSource=MSSSRC1   LoadPat=LIVE   Multiplier=0.3

END TABLE DATA
"""
"""A portal: 6 m wide, 4 m high, one column base pinned."""


def changed(text: str, *pairs: tuple[str, str]) -> str:
    """A text with other words in places, each of which it has."""
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def with_table(text: str, name: str, *rows: str) -> str:
    """A text with one more table."""
    table = "\n".join([f'TABLE:  "{name}"', *(f"   {row}" for row in rows), "", ""])
    return text.replace("END TABLE DATA", f"{table}END TABLE DATA")
