%@MACRO // rows of holes from a table in variables
#1 := 0;
@1 := 4;      // rows
@2 := 6;      // holes in a row
G71 G17 G40 G49 G80 G90 G94;
T2 M06;
G54 G00 X0. Y0. S2500 M03;
G43 Z20. H2;
FOR #1 := 0 TO @1 - 1 DO
  FOR #2 := 0 TO @2 - 1 DO
    IF (#1 + #2) MOD 2 = 0 THEN
      G00 X(10. + 15.*#2) Y(8. + 12.*#1);
      Z2.;
      G01 Z-6. F180.;
      G00 Z2.;
      #3 := #3 + 1;
    END_IF;
  END_FOR;
END_FOR;
G00 Z100.;
IF #3 <> 12 THEN
  ALARM(101, "wrong number of holes");
END_IF;
M30;
%
