C     Modified Cam clay of the formulas of include/stillpoint/cam_clay.hpp and cam_clay_flow.hpp, with the volume of now.
C     PROPS: M, lambda, kappa, nu, e0, OCR. STATEV(1): p_c, (2): void ratio, (3): plastic strain. If p_c is 0, the point
C     begins with OCR times that of the ellipse through its stress.
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),
     2 TIME(2),PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3)
      DIMENSION START(6),STATE(3),OTHER(6),DUMMY(3),CHANGED(6)
      PARAMETER (DIFFERENCE=1.D-7)
      IF (STATEV(1).EQ.0.D0) THEN
        P=-(STRESS(1)+STRESS(2)+STRESS(3))/3.D0
        STATEV(1)=PROPS(6)*(P+3.D0/PROPS(1)**2*AJ2(STRESS,NDI,NTENS)/P)
        STATEV(2)=PROPS(5)
        STATEV(3)=0.D0
      END IF
      DO I=1,NTENS
        START(I)=STRESS(I)
      END DO
      DO I=1,3
        STATE(I)=STATEV(I)
      END DO
      GROWTH=DET(DFGRD1)/DET(DFGRD0)-1.D0
      CALL CLAY(START,STATE,DSTRAN,GROWTH,NDI,NTENS,PROPS,STRESS,STATEV)
C     Moduli by differences
      DO J=1,NTENS
        DO K=-1,1,2
          SIGN=K
          DO I=1,NTENS
            CHANGED(I)=DSTRAN(I)
          END DO
          CHANGED(J)=CHANGED(J)+SIGN*DIFFERENCE
          OTHER_GROWTH=GROWTH
          IF (J.LE.NDI) OTHER_GROWTH=GROWTH+(1.D0+GROWTH)*SIGN*DIFFERENCE
          CALL CLAY(START,STATE,CHANGED,OTHER_GROWTH,NDI,NTENS,PROPS,
     1     OTHER,DUMMY)
          DO I=1,NTENS
            IF (SIGN.LT.0.D0) DDSDDE(I,J)=0.D0
            DDSDDE(I,J)=DDSDDE(I,J)+SIGN*OTHER(I)/(2.D0*DIFFERENCE)
          END DO
        END DO
      END DO
      RETURN
      END

C     The stress and the state after an increment of strain in which the volume grows by the share GROWTH
      SUBROUTINE CLAY(START,STATE,DSTRAN,GROWTH,NDI,NTENS,PROPS,
     1 STRESS,NEXT)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION START(NTENS),STATE(3),DSTRAN(NTENS),PROPS(6),
     1 STRESS(NTENS),NEXT(3),S(6),D(6)
      DOUBLE PRECISION NEXT
      PARAMETER (ROUNDING=1.D-14)
      OFSHEAR=3.D0/PROPS(1)**2
      AKAPPA=PROPS(3)
      R=1.5D0*(1.D0-2.D0*PROPS(4))/(1.D0+PROPS(4))
      C=2.D0*R*OFSHEAR
      RHO=AKAPPA/(PROPS(2)-AKAPPA)
      PC=STATE(1)
      V=1.D0+STATE(2)
      Y=-V*GROWTH/AKAPPA
      AMEANV=V*(1.D0+GROWTH/2.D0)
      P=-(START(1)+START(2)+START(3))/3.D0
      THIRD=(DSTRAN(1)+DSTRAN(2)+DSTRAN(3))/3.D0
      DO I=1,NTENS
        IF (I.LE.NDI) THEN
          S(I)=START(I)+P
          D(I)=2.D0*R*AMEANV/AKAPPA*(DSTRAN(I)-THIRD)
        ELSE
          S(I)=START(I)
          D(I)=R*AMEANV/AKAPPA*DSTRAN(I)
        END IF
      END DO
C     The elastic end
      IF (ABS(Y).LT.1.D-8) THEN
        GROWN=Y+Y*Y/2.D0
        PSI=1.D0+Y/2.D0
      ELSE
        GROWN=2.D0*SINH(Y/2.D0)*EXP(Y/2.D0)
        PSI=GROWN/Y
      END IF
      WHOLE=P*PSI
      PTRIAL=P+P*GROWN
      AJSS=OFSHEAR*HALFDOT(S,S,NDI,NTENS)
      AJSD=OFSHEAR*HALFDOT(S,D,NDI,NTENS)
      AJDD=OFSHEAR*HALFDOT(D,D,NDI,NTENS)
      F=AJSS+WHOLE*(2.D0*AJSD+WHOLE*AJDD)+PTRIAL*(PTRIAL-PC)
      NEXT(1)=PC
      NEXT(2)=V*(1.D0+GROWTH)-1.D0
      NEXT(3)=STATE(3)
      PEND=PTRIAL
      SHARES=1.D0
      SHARED=WHOLE
      IF (F.GT.ROUNDING*PC*PC) THEN
C       The share of the elastic path up to the ellipse, and what is left of the time
        RISE=P*GROWN
        A=WHOLE*WHOLE*AJDD+RISE*RISE
        B=WHOLE*AJSD+RISE*(P-PC/2.D0)
        OUTSIDE=MIN(0.D0,AJSS+P*(P-PC))
        ROOT=SQRT(B*B-A*OUTSIDE+(ROUNDING*PC*PC)**2)
        IF (B.GT.0.D0) THEN
          PHI=-OUTSIDE/(ROOT+B)
        ELSE
          PHI=(ROOT-B)/A
        END IF
        IF (ABS(Y).LT.1.D-5) THEN
          TIME=PHI*(1.D0+(1.D0-PHI)*Y*(0.5D0+(1.D0-2.D0*PHI)*Y/6.D0))
        ELSE
          TIME=LOG(1.D0+PHI*GROWN)/Y
        END IF
        ALEFT=1.D0-TIME
        PYIELD=P+P*PHI*GROWN
C       The stress ratio xi = alpha xi_0 + beta a, by three steps of the classical method of order 4
        BS=PHI*WHOLE
        XIXI=(AJSS+BS*(2.D0*AJSD+BS*AJDD))/PYIELD**2
        XIA=(AJSD+BS*AJDD)*ALEFT/PYIELD
        AA=AJDD*ALEFT**2
        Y=ALEFT*Y
        ALPHA=1.D0
        BETA=0.D0
        FLOWN=0.D0
        FASTEST=0.D0
        DO K=1,3
          SUMA=0.D0
          SUMB=0.D0
          A1=0.D0
          B1=0.D0
          DO L=1,4
            AT=0.D0
            IF (L.EQ.2.OR.L.EQ.3) AT=1.D0/6.D0
            IF (L.EQ.4) AT=1.D0/3.D0
            AL=ALPHA+AT*A1
            BE=BETA+AT*B1
            U2=AL*AL*XIXI+2.D0*AL*BE*XIA+BE*BE*AA
            DRY=1.D0-U2
            AN=(Y*DRY+2.D0*(AL*XIA+BE*AA))/
     1       (1.D0+RHO+U2*(2.D0*(C-1.D0)+(1.D0-RHO)*U2))
            G=Y+(C-DRY)*AN
            FASTEST=MAX(FASTEST,ABS(G))
            A1=-G*AL
            B1=1.D0-G*BE
            WEIGHT=1.D0
            IF (L.EQ.2.OR.L.EQ.3) WEIGHT=2.D0
            SUMA=SUMA+WEIGHT*A1
            SUMB=SUMB+WEIGHT*B1
            FLOWN=FLOWN+WEIGHT*AN/18.D0
          END DO
          ALPHA=ALPHA+SUMA/18.D0
          BETA=BETA+SUMB/18.D0
        END DO
        OFS=ALPHA/PYIELD
        OFD=OFS*BS+BETA*ALEFT
        ELLIPSE=1.D0+AJSS*OFS**2+OFD*(2.D0*AJSD*OFS+AJDD*OFD)
        PEND=PTRIAL*(PTRIAL*ELLIPSE/PC)**(-1.D0/(1.D0+RHO))
        SHARES=PEND*OFS
        SHARED=PEND*OFD
        NEXT(1)=PEND*ELLIPSE
        U2=ELLIPSE-1.D0
        NEXT(3)=STATE(3)+AKAPPA*FLOWN/AMEANV*
     1   SQRT(2.D0*((1.D0-U2)**2/3.D0+2.D0*OFSHEAR*U2))
C       What the flow does not resolve has no answer: a smaller step follows
        IF (.NOT.FASTEST.LE.6.D0) PEND=LOG(-1.D0+0.D0*PEND)
      END IF
      DO I=1,NTENS
        STRESS(I)=SHARES*S(I)+SHARED*D(I)
        IF (I.LE.NDI) STRESS(I)=STRESS(I)-PEND
      END DO
      RETURN
      END

C     a : b/2 of two deviators
      DOUBLE PRECISION FUNCTION HALFDOT(A,B,NDI,NTENS)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION A(NTENS),B(NTENS)
      HALFDOT=0.D0
      DO I=1,NTENS
        W=1.D0
        IF (I.LE.NDI) W=0.5D0
        HALFDOT=HALFDOT+W*A(I)*B(I)
      END DO
      END

C     J2 of a stress
      DOUBLE PRECISION FUNCTION AJ2(STRESS,NDI,NTENS)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION STRESS(NTENS),S(6)
      P=(STRESS(1)+STRESS(2)+STRESS(3))/3.D0
      DO I=1,NTENS
        S(I)=STRESS(I)
        IF (I.LE.NDI) S(I)=S(I)-P
      END DO
      AJ2=HALFDOT(S,S,NDI,NTENS)
      END

      DOUBLE PRECISION FUNCTION DET(A)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION A(3,3)
      DET=A(1,1)*(A(2,2)*A(3,3)-A(2,3)*A(3,2))
     1 -A(1,2)*(A(2,1)*A(3,3)-A(2,3)*A(3,1))
     2 +A(1,3)*(A(2,1)*A(3,2)-A(2,2)*A(3,1))
      END
