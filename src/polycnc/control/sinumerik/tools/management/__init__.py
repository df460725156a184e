"""Tool management: what the manual names (job planning 16.1) and the Function Manual Tool Management explains.

lists       NEWT, DELT, GETT, GETSELT, GETEXET, GETACTT, TCA, SETMTH, and which of several tools of a name T means
monitoring  $TC_MOP, SETPIECE, RESETMON
wear_groups  SETTA, SETTIA
environments  TOOLENV, DELTOOLENV, GETTENV, and LENTOAX
components  GETTCOR
corrections  SETTCOR
systems     MCS, BCS, WCS, KCS, TCS: how each sees lengths of the tool
adapters    $TC_ADPT
magazines   $TC_MAP, $TC_MPP, GETFREELOC, MVTOOL, POSM, TCI, CHKDM
"""
