"""Tool management: what the manual names (job planning 16.1) and the Function Manual Tool Management explains.

lists       NEWT, GETT, GETSELT, GETEXET, GETACTT, TCA, and which of several tools of a name T means
monitoring  $TC_MOP, SETPIECE, RESETMON
environments  TOOLENV, DELTOOLENV, GETTENV, and LENTOAX
components  GETTCOR
magazines   $TC_MAP, $TC_MPP, GETFREELOC, MVTOOL, CHKDM
"""
